#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A similarity of space that scales and translates: x goes to `to` + `scale` (x - `from`). Differences of positions
/// and lengths are multiplied by `scale`.
struct Similarity {
    Point from = Point::Zero();
    double scale = 1.0;
    Point to = Point::Zero();

    template <class Position>
    [[nodiscard]] Point operator()(const Position& x) const
    {
        return to + scale * (x - from);
    }
};

/// A map of a surface: a similarity for each of its components.
struct SimilarityOfComponents {
    /// #V: the component of each vertex; -1 for vertices without faces.
    std::span<const Index> component_of;
    /// One for each component; empty: the identity.
    std::vector<Similarity> maps;

    template <class Position>
    [[nodiscard]] Point operator()(Index v, const Position& x) const
    {
        return maps.empty() || component_of[v] < 0 ? Point(x) : maps[component_of[v]](x);
    }
};

}  // namespace seamflow
