#pragma once

#include <cstddef>

#include "solvers/laplacian/geometry.h"

/// Products with K, added up while it is assembled.
namespace seamflow {

/// A product with factor · K at positions V.
struct StiffnessProduct {
    /// #V by 3: X.
    const Points& increments;
    /// #V by 3: receives factor · K (V + X), or factor · K X. The rows of K sum to zero: the product is computed from
    /// differences, so that it has no rounding error of the size of V.
    Points& result;
    bool of_increments_alone = false;
};

/// Calls assemble_with(add), where add(v, w, k, d) with k = factor · K_vw and d = V_w - V_v adds the pair's share of
/// the product. Without a product, add does nothing.
template <class AssembleWith>
void with_product(const StiffnessProduct* product, AssembleWith&& assemble_with)
{
    if (product == nullptr)
        return assemble_with([](Index, Index, double, const Point&) {});
    const Points& x = product->increments;
    Points& result = product->result;
    result.setZero();
    const auto add_with = [&](auto&& vector_of) {
        assemble_with([&](Index v, Index w, double entry, const Point& difference) {
            const Point change = entry * vector_of(difference, x.row(w) - x.row(v));
            result.row(v) += change;
            result.row(w) -= change;
        });
    };
    if (product->of_increments_alone)
        add_with([](const Point&, const Point& increment) -> Point { return increment; });
    else
        add_with([](const Point& difference, const Point& increment) -> Point { return difference + increment; });
}

/// Adds the share of an auxiliary unknown to the product: -c (cᵀ u) / d, c being the column of C for the unknown and u
/// = V - V₀ + X - X₀ (or X - X₀ for the product with X alone), V₀ and X₀ those of one corner; and the term by which the
/// rows of S do not sum to zero.
/// @param n the number of corners. @param vertex gives the i-th corner. @param entry gives its entry of c. @param d the
/// entry of D.
template <class VertexOf, class EntryOf>
void add_auxiliary(const StiffnessProduct& product, const Points& positions, std::size_t n, VertexOf&& vertex,
                   EntryOf&& entry, double d)
{
    const Index first = vertex(0);
    const auto u = [&](Index v) -> Point {
        const Point increment = product.increments.row(v) - product.increments.row(first);
        return product.of_increments_alone ? increment : positions.row(v) - positions.row(first) + increment;
    };
    Point mean = Point::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        mean -= entry(i) / d * u(vertex(i));
        total -= entry(i) / d;
    }
    for (std::size_t i = 0; i < n; ++i)
        product.result.row(vertex(i)) += entry(i) * (mean - total * u(vertex(i)));
}

}  // namespace seamflow
