#pragma once

#include <filesystem>

#include "engine/options/flow_options.h"
#include "samples/benchmark/methods/whole_system.h"

namespace seamflow {

/// Writes the equations of a flow's first step for other solvers to try, as Matrix Market files into a folder:
///     system.mtx, system_rhs.mtx          as they stand, one row per vertex (#V by #V, #V by 3)
///     symmetric.mtx, symmetric_rhs.mtx    symmetric positive definite, without the vertices that stay; not for Δ_P
///     symmetric_vertices.mtx              vertex of each unknown of the latter, numbered from 1 like its rows
///     positions.mtx                       V⁰, where iterations may start (#V by 3)
/// @throws OutputError naming the file.
void export_first_step(const std::filesystem::path& folder, const PolygonMesh& mesh, const FlowOptions& options);

/// Writes a matrix stored by columns; of a symmetric one, the lower triangle.
void write_matrix(const std::filesystem::path& path, const WholeSystem& system, SystemForm form);

}  // namespace seamflow
