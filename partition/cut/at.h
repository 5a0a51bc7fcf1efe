#pragma once

#include <cstddef>

#include "partition/polygon_mesh.h"

namespace seamflow
{

/// An index that is known not to be negative, as a subscript of a standard container.
inline std::size_t at(Index i)
{
    return static_cast<std::size_t>(i);
}

}  // namespace seamflow
