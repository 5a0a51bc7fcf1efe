#pragma once

#include <array>
#include <functional>
#include <vector>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "solvers/columns.h"

namespace seamflow {

/// The generalised minimal residual method of Saad and Schultz (1986) for A X = B with any regular matrix A and three
/// right-hand sides, each with a subspace of its own. It never breaks down: where a subspace has become invariant, that
/// column is solved. Directions are orthogonalised twice. Sums are taken in a fixed order: the bits do not depend on
/// how loops are run.
class Gmres {
  public:
    /// Product = A P, #unknowns by 3 each.
    using Multiply = std::function<void(const Points& p, Points& product)>;

    /// @param n number of unknowns.
    explicit Gmres(Index n)
        : n_(n)
    {
    }

    /// Adds to X what makes the residual smallest, from X's residual on.
    /// @param residual B - A X.
    /// @param goal ends when the residual is estimated to be no larger, in the Euclidean norm over all three columns.
    /// @param most products with A, and directions to be kept, 24 n bytes each.
    /// @returns how many there were.
    int improve(const Multiply& multiply, const Points& residual, double goal, int most, Points& x, const Loop& loop);

  private:
    /// One number per column.
    using Triple = Eigen::Array<double, 1, 3>;
    /// Turns one column's Hessenberg matrix into a triangle.
    struct Rotation {
        Triple cosine;
        Triple sine;
    };

    void begin(const Points& residual, int most, const Loop& loop);
    void orthogonalise(int j, const Loop& loop);
    void take_away(int n_directions, const std::vector<Triple>& amounts, const Loop& loop);
    [[nodiscard]] std::vector<Triple> project(int n_directions, const Loop& loop) const;
    [[nodiscard]] Triple norms(const Points& a, const Loop& loop) const;
    void rotate(int j);
    void add_combination(int n_directions, Points& x, const Loop& loop) const;

    Index n_;
    /// Orthonormal, column by column; zero where a column needs no more.
    std::vector<Points> directions_;
    /// The product that is being orthogonalised.
    Points product_;
    /// Column after column of the triangles, each with an entry more than the one before; then Qᵀ ‖R₀‖ e₁.
    std::vector<std::vector<Triple>> triangle_;
    std::vector<Rotation> rotations_;
    std::vector<Triple> right_hand_side_;
};

/// The Euclidean norm over all three columns, its sum taken in a fixed order.
double norm(const Points& a, const Loop& loop);

}  // namespace seamflow
