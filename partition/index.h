#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace seamflow {

/// Index of a vertex, face, half-edge or sub-mesh.
using Index = std::int32_t;

/// An edge by its two vertices.
using Edge = std::array<Index, 2>;

/// Converts an index for comparisons with container sizes, as in `usize(h) < twin.size()`. Subscripts need no such
/// cast: a container that checks them (_GLIBCXX_ASSERTIONS, as in the preset debug) also rejects negative ones.
constexpr std::size_t usize(Index i)
{
    return static_cast<std::size_t>(i);
}

}  // namespace seamflow
