#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Three right-hand sides or solutions, n by 3, one contiguous column per coordinate.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

/// Gives an array n uninitialised rows. Like Eigen's resize, but safe if memory runs out: resize frees the old memory
/// before it allocates, and if that fails, frees the same again in the end.
/// @param array of a fixed number of columns.
/// @throws std::bad_alloc; the array is empty then.
template <class Array>
void set_rows(Array& array, Eigen::Index n)
{
    if (array.rows() != n)
        array.resize(0, Array::ColsAtCompileTime);
    array.resize(n, Array::ColsAtCompileTime);
}

/// Copies the rows of some vertices.
/// @param rows #V by 3. @param gathered receives #vertices by 3. @returns `gathered`.
inline const Points& gather_rows(std::span<const Index> vertices, const Points& rows, Points& gathered)
{
    set_rows(gathered, static_cast<Eigen::Index>(vertices.size()));
    for (std::size_t v = 0; v < vertices.size(); ++v)
        gathered.row(static_cast<Eigen::Index>(v)) = rows.row(vertices[v]);
    return gathered;
}

}  // namespace seamflow
