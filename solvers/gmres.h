#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The generalised minimal residual method of Saad and Schultz (1986) for A X = B with any regular matrix A and three
/// right-hand sides, which look for their solutions in one subspace together (block GMRES, Vital 1990). It does not
/// break down: directions that depend on others are left out. Orthogonalised twice. Sums are taken in a fixed order:
/// the bits do not depend on how loops are run.
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
    ///        Where that says too little of X, because the amplification is more than most_amplification, the goal is
    ///        divided by what it is too much.
    /// @param most products with A, for each of which 24 n bytes are kept.
    /// @returns how many there were.
    int improve(const Multiply& multiply, const Points& residual, double goal, int most, Points& x, const Loop& loop);

    /// How many times longer than its residual an error can be that lies in the directions of the last call: the norm
    /// of A⁻¹ there, by power iteration. At least 1.
    [[nodiscard]] double amplification() const;

    static constexpr double most_amplification = 100.0;

  private:
    /// Of rows `first` and `second`.
    struct Rotation {
        std::size_t first;
        std::size_t second;
        double cosine;
        double sine;
    };

    void begin(const Points& residual, const Loop& loop);
    void orthogonalise(const Loop& loop);
    [[nodiscard]] Eigen::Matrix3d normalise(const Eigen::RowVector3d& sizes, const Loop& loop);
    [[nodiscard]] std::vector<Eigen::Matrix3d> project(const Loop& loop) const;
    void take_away(const std::vector<Eigen::Matrix3d>& amounts, const Loop& loop);
    void rotate(std::vector<double> column);
    [[nodiscard]] double estimated_residual() const;
    [[nodiscard]] bool has_reached(double goal);
    void divide_by_transpose(Eigen::VectorXd& z) const;
    void divide(Eigen::VectorXd& z) const;
    void add_combination(Points& x, const Loop& loop) const;
    [[nodiscard]] Eigen::RowVector3d products_with_column(Eigen::Index c, const Loop& loop) const;

    Index n_;
    /// In threes, orthonormal or zero. The first `n_used_` of the list are in use.
    std::vector<Points> directions_;
    std::size_t n_used_ = 0;
    /// What is being orthogonalised: the next directions in the end.
    Points product_;
    /// What rotations have made of the Hessenberg matrix, column by column, and of the right-hand sides, row by row.
    std::vector<std::vector<double>> triangle_;
    /// Columns of it from which on the amplification is found anew.
    std::size_t next_size_to_check_ = 0;
    std::vector<Rotation> rotations_;
    std::vector<Eigen::RowVector3d> right_hand_side_;
};

/// The Euclidean norm over all three columns, its sum taken in a fixed order.
double norm(const Points& a, const Loop& loop);

}  // namespace seamflow
