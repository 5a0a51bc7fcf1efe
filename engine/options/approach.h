#pragma once

namespace seamflow {

/// The solver of a backward Euler step.
enum class Approach {
    /// The fastest of Decomposed, ConjugateGradients and Undecomposed, by a cost model. It is Decomposed if another
    /// option concerns sub-meshes or sweeps, or if the Laplacian is not symmetric; but Undecomposed if such a Laplacian
    /// has a tolerance, given or chosen.
    Automatic,
    /// Steps in sub-meshes: Converged if there is a tolerance, or if a loose one pays; otherwise Sweep.
    Decomposed,
    /// One pass over the sub-meshes, colour by colour (adjacent sub-meshes have different colours), in which each
    /// sub-mesh solves once: near the undecomposed step, not equal to it. Not with a tolerance.
    Sweep,
    /// Sub-meshes that converge to the undecomposed step, to AccuracyOptions::tolerance or a loose one.
    Converged,
    /// Conjugate gradients on the whole mesh, to AccuracyOptions::tolerance or a loose one: no sub-meshes, no
    /// factorisation, and the shortest set-up. For symmetric Laplacians.
    ConjugateGradients,
    /// One factorisation of the whole mesh: exact.
    Undecomposed,
};

/// Whether steps are taken without sub-meshes.
constexpr bool takes_whole_mesh(Approach approach)
{
    return approach == Approach::ConjugateGradients || approach == Approach::Undecomposed;
}

}  // namespace seamflow
