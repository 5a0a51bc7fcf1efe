#pragma once

#include <vector>

#include <Eigen/Core>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The orthonormal basis V₁, V₂, … that block GMRES makes of a residual and its products with A, by Arnoldi's method
/// with modified Gram-Schmidt, done twice. Each V has three columns, orthonormal or zero: those that depend on others
/// are left out.
class KrylovBasis {
  public:
    /// @param n number of unknowns.
    explicit KrylovBasis(Index n)
        : n_(n)
    {
    }

    /// Forgets what there was. The residual becomes W, of orthonormal columns.
    /// @returns the triangle R with residual = W R.
    Eigen::Matrix3d begin(const Points& residual, const Loop& loop);

    /// Takes W in as the next V, and makes W = A V of it.
    /// @param multiply multiply(V, product) makes the product, #unknowns by 3.
    template <class Multiply>
    void extend(const Multiply& multiply)
    {
        append();
        multiply(blocks_[n_used_ - 1], product_);
    }

    /// Makes the columns of W orthonormal and orthogonal to all V.
    /// @returns H₁, H₂, … with V₁ H₁ + V₂ H₂ + … = the W before, the last one the triangle that belongs to the new W.
    std::vector<Eigen::Matrix3d> orthogonalise(const Loop& loop);

    /// x += V₁ Y₁ + V₂ Y₂ + …
    /// @param y three rows for each V.
    void add_combination(const Eigen::MatrixXd& y, Points& x, const Loop& loop) const;

  private:
    void append();
    [[nodiscard]] Eigen::Matrix3d normalise(const Eigen::RowVector3d& sizes, const Loop& loop);
    [[nodiscard]] std::vector<Eigen::Matrix3d> project(const Loop& loop) const;
    void subtract(const std::vector<Eigen::Matrix3d>& amounts, const Loop& loop);
    [[nodiscard]] Eigen::RowVector3d products_with_column(Eigen::Index c, const Loop& loop) const;

    Index n_;
    /// The first `n_used_` of the list are in use.
    std::vector<Points> blocks_;
    std::size_t n_used_ = 0;
    Points product_;
};

}  // namespace seamflow
