#pragma once

#include <string>

#include "engine/measure/mesh_size.h"

namespace seamflow {

/// What sub-meshes have to be like for a kind of step.
struct SubdomainNeeds {
    /// Setup and steps cost little per vertex in sub-meshes of about this size, and a million vertices make enough of
    /// them to keep 64 threads busy.
    Index vertices;
    /// In √dt: below that the flow drifts away from the undecomposed one, or converged steps take more and more
    /// iterations.
    double width;
};

inline constexpr SubdomainNeeds needs_of_sweeps{2'500, 10.0};
/// Those of Laplacians without symmetry, whose factors grow faster with sub-meshes.
inline constexpr SubdomainNeeds needs_of_unsymmetric_sweeps{1'000, 10.0};
inline constexpr SubdomainNeeds needs_of_converged_steps{2'000, 2.0};
/// Converged steps of Laplacians without symmetry, whose sub-meshes overlap.
inline constexpr SubdomainNeeds needs_of_krylov_steps{1'000, 2.0};

/// A number of sub-meshes and the reason for it.
struct SubdomainChoice {
    Index count = 1;
    std::string reason;
};

/// Sub-meshes of the size that costs little, but on average no narrower than they need to be.
SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs);

/// Average width of k sub-meshes of a mesh of this area, the square root of their average area, in √dt.
double width_in_diffusion_lengths(double area, Index k, double time_step);

}  // namespace seamflow
