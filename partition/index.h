#pragma once

#include <cstddef>
#include <cstdint>

namespace seamflow {

/// Index of a vertex, face, half-edge or sub-mesh.
using Index = std::int32_t;

/// An index as a subscript of a standard container: twin[at(h)].
constexpr std::size_t at(Index i)
{
    return static_cast<std::size_t>(i);
}

}  // namespace seamflow
