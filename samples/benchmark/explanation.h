#pragma once

#include <array>
#include <iosfwd>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/setup/automatic_choices.h"
#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// How ours takes steps of symmetric Laplacians, with the methods that take them so.
inline constexpr std::array our_approaches{
    std::pair{Approach::Sweep, Method::OurSweep}, std::pair{Approach::Converged, Method::OurConverged},
    std::pair{Approach::ConjugateGradients, Method::OurCg}, std::pair{Approach::Undecomposed, Method::Undecomposed}};

/// The reasons for the approach of ours: the predictions of the cost model for each approach, and the measurements.
struct Explanation {
    FlowSize size;
    int threads = 1;
    /// Of memory (see triad_bandwidth), with one thread and with those of the flow, in bytes per second.
    double bandwidth_of_one = 0.0;
    double bandwidth = 0.0;
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
