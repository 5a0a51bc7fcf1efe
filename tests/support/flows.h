#pragma once

#include <array>

#include "engine/mean_curvature_flow.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

inline constexpr std::array all_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho};

/// The positions after a flow.
inline Points flowed(PolygonMesh mesh, const FlowOptions& options)
{
    mean_curvature_flow(mesh, options);
    return mesh.vertices;
}

/// The largest difference of any two corresponding coordinates.
inline double largest_difference(const Points& a, const Points& b)
{
    return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace seamflow::test
