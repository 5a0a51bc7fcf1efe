#pragma once

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Averages over the rows of a Laplacian M⁻¹ K.
struct RowAverages {
    /// The number of off-diagonal coefficients.
    double length = 0.0;
    /// K_vv / M_v, in 1/length². With their diagonal as preconditioner, the equations M + dt K have a condition number
    /// of about 2 dt times this.
    double stiffness = 0.0;
};

/// Averages over some hundred interior vertices that move, spread evenly; all 0 if there are none.
/// @throws OptionError for an unsymmetric Laplacian.
RowAverages average_rows(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian);

}  // namespace seamflow
