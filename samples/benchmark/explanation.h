#pragma once

#include <iosfwd>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/setup/automatic_choices.h"
#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// Why ours takes its steps as it does: what the model of costs expects of each approach, and what was measured.
struct Explanation {
    FlowSize size;
    /// What is chosen where nothing is said.
    Approach chosen = Approach::Automatic;
    /// One approach.
    struct Entry {
        PredictedCost predicted;
        /// What MethodResult says; the distance, where there is a reference.
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
