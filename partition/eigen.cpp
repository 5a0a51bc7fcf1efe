#include "partition/eigen.h"

#include <limits>

#include <fmt/format.h>

namespace seamflow {

namespace {

/// The largest number of vertices, and of corners.
constexpr Eigen::Index most = std::numeric_limits<Index>::max();

std::string shape(Eigen::Index rows, Eigen::Index columns)
{
    return fmt::format("{} by {}", rows, columns);
}

}  // namespace

void require_vertex_shape(Eigen::Index rows, Eigen::Index columns)
{
    if (columns != 3)
        throw InputError(fmt::format("the matrix of vertices is {}: it must have 3 columns, and a row per vertex",
                                     shape(rows, columns)));
    if (rows > most)
        throw InputError(fmt::format("the matrix of vertices has {} rows: at most {} are allowed", rows, most));
}

void require_face_shape(Eigen::Index rows, Eigen::Index columns)
{
    if (rows == 0)
        return;
    if (columns < 3)
        throw InputError(fmt::format("the matrix of faces is {}: it must have 3 columns or more, and a row per face",
                                     shape(rows, columns)));
    if (rows > most / columns)
        throw InputError(
            fmt::format("the matrix of faces is {}: at most {} corners are allowed", shape(rows, columns), most));
}

}  // namespace seamflow
