#pragma once

#include <string>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Sub-meshes narrower than this many √dt let the decomposed flow drift away from the undecomposed one.
inline constexpr double good_width_in_diffusion_lengths = 10.0;

/// A number of sub-meshes and the reason for it.
struct SubdomainChoice {
    Index count = 1;
    std::string reason;
};

/// Sub-meshes of a few thousand vertices, which cost least per vertex, but on average no narrower than
/// good_width_in_diffusion_lengths · √dt.
SubdomainChoice choose_subdomains(const PolygonMesh& mesh, double time_step);

/// Average width of k sub-meshes, the square root of their average area, in √dt.
double width_in_diffusion_lengths(const PolygonMesh& mesh, Index k, double time_step);

}  // namespace seamflow
