#pragma once

#include <iosfwd>
#include <string>

#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// What `inspect` found, for reading: sizes, then each kind of finding with what `smooth` does about it.
/// @param most_listed how many elements of each kind are named.
void print_inspection(std::ostream& out, const std::string& file, const FaultLog& faults, const MeshInspection& found,
                      int most_listed);

}  // namespace seamflow
