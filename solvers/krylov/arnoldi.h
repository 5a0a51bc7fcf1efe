#pragma once

#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

/// Parts of block GMRES: Arnoldi's basis, and the least-squares problem in it.
namespace seamflow {

/// The orthonormal basis V₁, V₂, … that block GMRES builds from a residual and its products with A, by Arnoldi's method
/// with modified Gram-Schmidt, done twice. Each V has three columns, orthonormal or zero: linearly dependent ones are
/// left out.
class KrylovBasis {
  public:
    /// @param n number of unknowns.
    explicit KrylovBasis(Index n)
        : n_(n)
    {
    }

    /// Starts anew. The residual becomes W, with orthonormal columns.
    /// @returns the triangle R with residual = W R.
    Eigen::Matrix3d begin(const Points& residual, const Executor& exec);

    /// Appends W as the next V, and computes W = A V.
    /// @param multiply multiply(V, product) makes the product, #unknowns by 3.
    template <class Multiply>
    void extend(const Multiply& multiply)
    {
        append();
        multiply(blocks_[n_used_ - 1], product_);
    }

    /// Makes the columns of W orthonormal and orthogonal to all V.
    /// @returns H₁, H₂, … with V₁ H₁ + V₂ H₂ + … = the W before, the last one the triangle that belongs to the new W.
    std::vector<Eigen::Matrix3d> orthogonalise(const Executor& exec);

    /// x += V₁ Y₁ + V₂ Y₂ + …
    /// @param y three rows for each V.
    void add_combination(const Eigen::MatrixXd& y, Points& x, const Executor& exec) const;

  private:
    void append();
    [[nodiscard]] Eigen::Matrix3d normalise(const Eigen::RowVector3d& sizes, const Executor& exec);
    [[nodiscard]] std::vector<Eigen::Matrix3d> project(const Executor& exec) const;
    void subtract(const std::vector<Eigen::Matrix3d>& amounts, const Executor& exec);
    [[nodiscard]] Eigen::RowVector3d products_with_column(Eigen::Index c, const Executor& exec) const;

    Index n_;
    /// The first `n_used_` of the list are in use.
    std::vector<Points> blocks_;
    std::size_t n_used_ = 0;
    Points product_;
};

/// Above this amplification of the error over its residual, the residual is an unreliable measure.
inline constexpr double most_amplification = 100.0;

/// The small least-squares problem of block GMRES, for three right-hand sides: its block Hessenberg matrix, made
/// triangular by Givens rotations as its columns come.
class HessenbergLeastSquares {
  public:
    /// @param first the first three rows of the right-hand sides; the others are 0.
    explicit HessenbergLeastSquares(const Eigen::Matrix3d& first);

    /// Appends three columns of the Hessenberg matrix, and three rows.
    /// @param blocks of these columns, three rows each.
    void append(const std::vector<Eigen::Matrix3d>& blocks);

    /// Whether the residual is no larger than the goal, divided by amplification / most_amplification if above 1.
    [[nodiscard]] bool has_reached(double goal);

    /// How many times longer than its residual an error can be: the norm of the triangle's inverse, by power
    /// iteration. At least 1.
    [[nodiscard]] double amplification() const;

    /// Three rows for each column block. Zero columns do not contribute.
    [[nodiscard]] Eigen::MatrixXd solution() const;

  private:
    /// Of rows `first` and `second`.
    struct Rotation {
        std::size_t first;
        std::size_t second;
        double cosine;
        double sine;
    };

    void rotate(std::vector<double> column);
    [[nodiscard]] double residual() const;
    void divide_by_transpose(Eigen::VectorXd& z) const;
    void divide(Eigen::VectorXd& z) const;

    /// The matrix after the rotations, column by column, and the right-hand sides, row by row.
    std::vector<std::vector<double>> triangle_;
    std::vector<Rotation> rotations_;
    std::vector<Eigen::RowVector3d> right_hand_side_;
    /// Number of columns at the next amplification estimate.
    std::size_t next_size_to_check_ = 0;
};

}  // namespace seamflow
