#pragma once

#include <array>
#include <span>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/loop.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// When the iteration for the interface equation ends.
struct InterfaceStop {
    /// Residual relative to that at the beginning, in the Euclidean norm, for each of x, y and z.
    double tolerance = 0.0;
    /// Most iterations.
    int iterations = 0;
};

/// How it ended.
struct InterfaceResult {
    int iterations = 0;
    /// Largest of the three relative residuals.
    double residual = 0.0;
};

/// The whole backward Euler step as an equation on Γ alone: Σ S_i x = Σ g_i over the sub-meshes' Schur complements.
/// Solved for x, y and z at once by conjugate gradients, preconditioned by Σ W S_i⁻¹ W with W = 1 / number of
/// sub-meshes at the vertex (Neumann-Neumann). The products are in single precision, the residual is renewed in double
/// precision. Sums are taken in a fixed order: the bits do not depend on how loops are run.
class InterfaceEquation {
  public:
    /// @param decomposition without overlap; must outlive the equation.
    explicit InterfaceEquation(const Decomposition& decomposition);

    /// Number of vertices on Γ.
    [[nodiscard]] Index size() const { return static_cast<Index>(copy_offsets_.size()) - 1; }

    /// Where sub-mesh s has its rows in arrays of copies, which have one row for each vertex of each sub-mesh's Γ.
    [[nodiscard]] Index first_copy(Index s) const { return first_copy_[at(s)]; }
    [[nodiscard]] Index n_copies() const { return first_copy_.back(); }

    /// The vertex of Γ that a copy is of.
    [[nodiscard]] Index vertex_of_copy(Index copy) const { return vertex_of_copy_[at(copy)]; }

    /// Solves, starting from x.
    /// @param systems factorised.
    /// @param x size() by 3.
    /// @param right_hand_sides n_copies() by 3: Each sub-mesh's share g_i.
    InterfaceResult solve(std::span<const NeumannSystem* const> systems, const Points& right_hand_sides,
                          const InterfaceStop& stop, Points& x, const Loop& loop);

  private:
    using Sums = std::array<double, 3>;

    void measure_residual(std::span<const NeumannSystem* const> systems, const Points& right_hand_sides,
                          const Points& x, const Loop& loop);
    int iterate(std::span<const NeumannSystem* const> systems, const Sums& goals, int most, Points& x,
                const Loop& loop);
    void multiply(std::span<const NeumannSystem* const> systems, const Loop& loop);
    void precondition(std::span<const NeumannSystem* const> systems, const Loop& loop);
    template <class Apply>
    void on_each(std::span<const NeumannSystem* const> systems, const Points& source, bool weighted, Points& target,
                 const Loop& loop, Apply&& apply);
    Sums dot(const Points& a, const Points& b, const Loop& loop);

    std::vector<Index> first_copy_;
    std::vector<Index> vertex_of_copy_;
    /// Per vertex of Γ, its copies in ascending order of the sub-meshes.
    std::vector<Index> copy_offsets_;
    std::vector<Index> copies_;
    /// Three columns for each sub-mesh.
    std::vector<float> products_;
    Points residual_copies_;
    Points residual_;
    Points direction_;
    Points product_;
    Points preconditioned_;
    std::vector<Sums> partial_;
};

}  // namespace seamflow
