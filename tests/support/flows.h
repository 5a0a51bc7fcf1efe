#pragma once

#include <array>
#include <cstring>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "samples/options/smooth_surface.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

inline constexpr std::array all_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement,
                                           Laplacian::PtackovaVelho, Laplacian::Uniform};
inline constexpr std::array symmetric_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky,
                                                 Laplacian::VirtualRefinement, Laplacian::Uniform};

/// Those that measure the surface, and those of them that are symmetric.
inline constexpr std::array geometric_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky,
                                                 Laplacian::VirtualRefinement, Laplacian::PtackovaVelho};
inline constexpr std::array symmetric_geometric_laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky,
                                                           Laplacian::VirtualRefinement};

/// The positions after a flow.
inline Points flowed(PolygonMesh mesh, const AllOptions& options)
{
    smooth_surface(mesh, options);
    return mesh.vertices;
}

/// The largest difference of any two corresponding coordinates.
inline double largest_difference(const Points& a, const Points& b)
{
    return (a - b).cwiseAbs().maxCoeff();
}

/// Whether two sets of positions are the same to the last bit.
inline bool same_bits(const Points& a, const Points& b)
{
    return a.rows() == b.rows() &&
           (a.size() == 0 || std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0);
}

/// A bumpy height field of each kind of polygons, each of about so many vertices.
inline std::vector<PolygonMesh> height_fields(Index n_vertices = 900)
{
    return {make_triangles(n_vertices), make_quads(n_vertices), make_hexagons(n_vertices),
            make_mixed_polygons(n_vertices)};
}

}  // namespace seamflow::test
