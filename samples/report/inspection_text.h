#pragma once

#include <iosfwd>
#include <string>

#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"
#include "samples/report/surface_roughness.h"

namespace seamflow {

/// Prints the findings of `inspect`: sizes, then each kind of finding with its treatment by `smooth`.
/// @param most_listed the most elements of each kind to name. @param roughness without noise if it is not measured.
void print_inspection(std::ostream& out, const std::string& file, const FaultLog& faults, const MeshInspection& found,
                      int most_listed, const SurfaceRoughness& roughness);

}  // namespace seamflow
