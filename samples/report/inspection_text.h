#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

/// Prints the findings of `inspect`: sizes, then each kind of finding with its treatment by `smooth`.
/// @param most_listed the most elements of each kind to name. @param noise empty if it is not measured.
void print_inspection(std::ostream& out, const std::string& file, const FaultLog& faults, const MeshInspection& found,
                      int most_listed, const std::optional<SurfaceNoise>& noise);

}  // namespace seamflow
