#pragma once

#include <iosfwd>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/setup/automatic_choices.h"
#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// The reasons for the approach of ours: the predictions of the cost model for each approach, and the measurements.
struct Explanation {
    FlowSize size;
    /// The approach that is chosen by default.
    Approach chosen = Approach::Automatic;
    /// One approach.
    struct Entry {
        PredictedCost predicted;
        /// The MethodResult; also the distance, if there is a reference.
        Row measured;
    };
    std::vector<Entry> entries;
};

/// Predicts the costs of all approaches, and runs each of them, in a process of its own.
/// @param flow of a symmetric Laplacian.
Explanation explain(const PolygonMesh& mesh, const FlowOptions& flow, Reference reference);

void print_explanation(std::ostream& out, const Explanation& explanation);
nlohmann::ordered_json explanation_json(const Explanation& explanation);

}  // namespace seamflow
