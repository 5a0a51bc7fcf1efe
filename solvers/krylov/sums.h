#pragma once

#include <cmath>
#include <functional>
#include <initializer_list>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The sum of value(i) over 0 … n - 1, of some matrix type. Always added up in the same order.
template <class Sum, class Value>
Sum sum_of(const Executor& exec, Index n, Value&& value)
{
    const Sum zero = Sum::Zero();
    return sum(exec, n, value, zero);
}

/// The inner products of each column of A with that of B.
inline Eigen::RowVector3d column_products(const Points& a, const Points& b, const Executor& exec)
{
    return sum_of<Eigen::RowVector3d>(exec, static_cast<Index>(a.rows()),
                                      [&](Index i) { return a.row(i).cwiseProduct(b.row(i)); });
}

/// The Euclidean norm of each column.
inline Eigen::RowVector3d column_norms(const Points& a, const Executor& exec)
{
    return column_products(a, a, exec).cwiseSqrt();
}

/// Two vectors for each of three columns.
struct VectorPair {
    const Points& a;
    const Points& b;
};

/// How the inner products of pairs of vectors are computed, of each column of A with that of B; all of them at once.
/// Always in the same order of additions.
using InnerProducts = std::function<std::vector<Point>(std::initializer_list<VectorPair> pairs, const Executor& exec)>;

/// One pair after the other, by column_products.
inline std::vector<Point> inner_products(std::initializer_list<VectorPair> pairs, const Executor& exec)
{
    std::vector<Point> products;
    for (const auto& [a, b] : pairs)
        products.emplace_back(column_products(a, b, exec));
    return products;
}

/// The Euclidean norm over all three columns.
inline double norm(const Points& a, const Executor& exec)
{
    return std::sqrt(sum(exec, static_cast<Index>(a.rows()), [&](Index i) { return a.row(i).squaredNorm(); }));
}

}  // namespace seamflow
