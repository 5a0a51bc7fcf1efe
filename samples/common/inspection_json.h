#pragma once

#include <string>

#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// What `inspect` found, whole.
std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found);

}  // namespace seamflow
