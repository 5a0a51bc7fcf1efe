#pragma once

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// What the rows of a Laplacian M⁻¹ K are like, on average.
struct RowAverages {
    /// The number of coefficients beside that of the diagonal.
    double length = 0.0;
    /// K_vv / M_v, in 1/length². With dt times it, the equations M + dt K have a condition number of about twice as
    /// much where they are preconditioned by their diagonal.
    double stiffness = 0.0;
};

/// Of some thousand interior vertices that move, spread evenly; all 0 if there are none.
/// @throws OptionError for a Laplacian without symmetry.
RowAverages average_rows(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian);

}  // namespace seamflow
