#pragma once

#include <cstdint>
#include <string_view>

#include "engine/measure/run_report.h"
#include "engine/options/motion_options.h"
#include "partition/remark.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A remark on faces that took no part in the flow, as they repeat others.
/// @param n at least 1.
Remark remark_on_repeated_faces(std::int64_t n);

/// A remark on vertices that are held because the mesh is not manifold there.
/// @param remedy the condition with which vertices at junctions would move, such as "In converged steps"; empty: the
///        remark does not mention it.
Remark remark_on_non_manifold_vertices(std::int64_t n, std::string_view remedy = {});

/// A remark on vertices that move where sheets meet.
Remark remark_on_junctions(std::int64_t n, Laplacian laplacian);

/// A remark on vertices that are held where the Laplacian is not defined.
/// @param first the lowest of them.
Remark remark_on_undefined_vertices(std::int64_t n, std::int64_t first, Laplacian laplacian);

/// A remark on a mesh none of whose vertices can move.
Remark remark_on_unmoving_mesh(Boundary boundary);

/// Adds a remark if the flow has shrunk the surface to less than a thousandth of its extent.
/// @param extent_before, extent_after the diagonals of the boxes around the faces.
void remark_on_collapse(double extent_before, double extent_after, RunReport& report);

}  // namespace seamflow
