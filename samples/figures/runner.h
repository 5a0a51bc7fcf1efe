#pragma once

#include <filesystem>
#include <iosfwd>

#include "samples/figures/experiment.h"
#include "samples/figures/table.h"

namespace seamflow {

/// Where an experiment finds its mesh and writes its results.
struct Places {
    /// The folder of the authors' files; empty: all meshes are generated.
    std::filesystem::path meshes;
    /// For the input and the last state of each flow as PLY, and the cut; empty: none.
    std::filesystem::path out;
    /// For a page with all flows that finish; empty: none.
    std::filesystem::path page = {};
};

/// Runs all flows of an experiment and measures each of their steps against the undecomposed flow by the same
/// Laplacian. A flow that cannot continue (a singular system, results that are not finite) ends there with a remark.
/// @param log gets a line for each flow.
/// @throws InputError, OutputError.
Table run_experiment(const Experiment& experiment, const Places& places, std::ostream& log);

}  // namespace seamflow
