#pragma once

#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "partition/errors.h"
#include "solvers/laplacian/alexa_wardetzky.h"
#include "solvers/laplacian/fujiwara.h"
#include "solvers/laplacian/ptackova_velho.h"
#include "solvers/laplacian/uniform.h"
#include "solvers/laplacian/virtual_refinement.h"

namespace seamflow {

/// A Laplacian M⁻¹ K that is a sum over edges. It has a class `Edge`, which `edge(difference)` makes from the
/// difference of an edge's ends:
/// - `weight(factor)`: -factor · K of the two ends; the rows of K sum to zero;
/// - `mass()`: its mean over the edges at v is M_v, or without `averages_mass` its sum.
template <class Kernel>
concept EdgeKernel = requires
{
    typename Kernel::Edge;
};

/// A Laplacian M⁻¹ K that is a sum over faces, with K = N / d in each face. Its function `polygon(corners, positions,
/// size, scratch)` makes the contribution of one face. Its arguments `size` and `scratch` are the number `size(corners,
/// positions)`, and memory of the type `Scratch`, which must outlive the result. The result has:
/// - `size()`, `corner(k)`: the number of vertices, and the k-th vertex;
/// - `row(i, scale)(k)`: scale · N_ik; the rows of N sum to zero;
/// - `divisor()`: d;
/// - `mass(k)`: the share of the face in M at corner k, equal to `corner_mass(size, number of corners)`;
/// - `difference(i, k)`: V_k - V_i, for i < k.
///
/// For faces with many corners K is also S - C D⁻¹ Cᵀ, with n numbers for each of these matrices: S has the entries
/// `ring(k)`, D is the diagonal matrix `auxiliary()`, of either sign, and C has the rows `coupling(k)`.
///
/// If the kernel also has a class `Triangle`, made from three corners, that class provides the same functions for
/// triangles, with fewer operations.
template <class Kernel>
concept FaceKernel = requires
{
    typename Kernel::Scratch;
};

/// Calls action(face, i) with the data for the row of corner k of a face, i being the index of that corner in `face`.
template <FaceKernel Kernel, class Action>
void measure_corner(std::span<const Index> corners, std::size_t k, const Points& positions, Action&& action)
{
    if constexpr (requires { typename Kernel::Triangle; })
        if (corners.size() == 3) {
            const std::array turned{corners[k], corners[k == 2 ? 0 : k + 1], corners[k == 0 ? 2 : k - 1]};
            return action(typename Kernel::Triangle(turned, positions), std::size_t{0});
        }
    thread_local typename Kernel::Scratch scratch;
    action(Kernel::polygon(corners, positions, Kernel::size(corners, positions), scratch), k);
}

/// Calls action(face) with the data for all rows of a face.
template <FaceKernel Kernel, class Action>
void measure_face(std::span<const Index> corners, const Points& positions, typename Kernel::Scratch& scratch,
                  Action&& action)
{
    if constexpr (requires { typename Kernel::Triangle; })
        if (corners.size() == 3)
            return action(typename Kernel::Triangle({corners[0], corners[1], corners[2]}, positions));
    action(Kernel::polygon(corners, positions, Kernel::size(corners, positions), scratch));
}

/// The kernels of all Laplacians.
using Kernels = std::tuple<Fujiwara, AlexaWardetzky, VirtualRefinement, PtackovaVelho, Uniform>;

/// Calls action with the kernel of a Laplacian.
/// @throws OptionError for an unknown Laplacian.
template <std::size_t First = 0, class Action>
auto with_kernel(const ScaledLaplacian& laplacian, Action&& action)
{
    using Kernel = std::tuple_element_t<First, Kernels>;
    if (laplacian.kind == Kernel::traits.laplacian) {
        if constexpr (requires { Kernel{laplacian.edge_length}; })
            return action(Kernel{laplacian.edge_length});
        else
            return action(Kernel{});
    }
    if constexpr (First + 1 < std::tuple_size_v<Kernels>)
        return with_kernel<First + 1>(laplacian, std::forward<Action>(action));
    else
        throw OptionError("no such Laplacian");
}

}  // namespace seamflow
