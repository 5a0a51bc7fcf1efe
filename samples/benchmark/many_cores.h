#pragma once

#include <iosfwd>
#include <vector>

#include <nlohmann/json.hpp>

#include "samples/benchmark/explanation.h"

namespace seamflow {

/// What each approach of ours takes here, and would take with more cores than there are.
struct ManyCores {
    /// Cores, seconds of the set-up and of a step.
    struct Cost {
        int cores = 1;
        double setup = 0.0;
        double step = 0.0;
    };
    struct Entry {
        Approach approach = Approach::Automatic;
        /// With the threads of the flow.
        Row measured;
        std::vector<Cost> costs;
    };
    int steps = 1;
    /// That conjugate gradients are bound by, in bytes per second.
    double bandwidth = 0.0;
    std::vector<Entry> entries;
};

/// Measures every approach with the threads of the flow, and extrapolates: the tasks of sweeps and converged steps are
/// replayed (see simulate); what they do besides is shared evenly; conjugate gradients take no less than memory takes
/// to move their matrix and vectors; the factor of the whole mesh has one thread; set-ups grow shorter as in the cost
/// model.
/// @param flow of a symmetric Laplacian.
/// @param bandwidth in bytes per second; 0: as measured with all cores that are here.
ManyCores measure_for_many_cores(const PolygonMesh& mesh, const FlowOptions& flow, const std::vector<int>& cores,
                                 double bandwidth);

void print_many_cores(std::ostream& out, const ManyCores& many);
nlohmann::ordered_json many_cores_json(const ManyCores& many);

}  // namespace seamflow
