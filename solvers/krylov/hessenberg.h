#pragma once

#include <vector>

#include <Eigen/Core>

namespace seamflow {

/// How much an error may be amplified against its residual before the residual says too little of it.
inline constexpr double most_amplification = 100.0;

/// The small least-squares problem of block GMRES, for three right-hand sides: its block Hessenberg matrix, made
/// triangular by Givens rotations as its columns come.
class HessenbergLeastSquares {
  public:
    /// @param first what the first three rows of the right-hand sides are; the others are 0.
    explicit HessenbergLeastSquares(const Eigen::Matrix3d& first);

    /// Appends three columns of the Hessenberg matrix, and three rows.
    /// @param blocks of these columns, three rows each.
    void append(const std::vector<Eigen::Matrix3d>& blocks);

    /// Whether the residual is no larger than the goal, divided by what the amplification is more than
    /// most_amplification.
    [[nodiscard]] bool has_reached(double goal);

    /// How many times longer than its residual an error can be: the norm of the triangle's inverse, by power
    /// iteration. At least 1.
    [[nodiscard]] double amplification() const;

    /// Three rows for each column block. Columns that are zero have no part in it.
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

    /// What rotations have made of the matrix, column by column, and of the right-hand sides, row by row.
    std::vector<std::vector<double>> triangle_;
    std::vector<Rotation> rotations_;
    std::vector<Eigen::RowVector3d> right_hand_side_;
    /// Columns from which on the amplification is found anew.
    std::size_t next_size_to_check_ = 0;
};

}  // namespace seamflow
