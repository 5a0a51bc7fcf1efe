#pragma once

#include <Eigen/Core>

namespace seamflow {

/// Three right-hand sides or solutions, n by 3, one contiguous column per coordinate.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

/// Gives an array n rows, whose values are not set. As Eigen's resize, but safe where memory lacks: that frees what
/// there was before it asks for more, and where it does not get it, frees the same again in the end.
/// @param array of a fixed number of columns.
/// @throws std::bad_alloc; the array is empty then.
template <class Array>
void set_rows(Array& array, Eigen::Index n)
{
    if (array.rows() != n)
        array.resize(0, Array::ColsAtCompileTime);
    array.resize(n, Array::ColsAtCompileTime);
}

}  // namespace seamflow
