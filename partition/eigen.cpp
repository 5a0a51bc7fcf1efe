#include "partition/eigen.h"

#include <limits>

namespace seamflow {

namespace {

constexpr Eigen::Index most = std::numeric_limits<Index>::max();

std::string shape(Eigen::Index rows, Eigen::Index columns)
{
    return std::to_string(rows) + " by " + std::to_string(columns);
}

}  // namespace

void require_vertex_shape(Eigen::Index rows, Eigen::Index columns)
{
    if (columns != 3)
        throw InputError("the matrix of vertices is " + shape(rows, columns) +
                         ": it must have 3 columns, and a row per vertex");
    if (rows > most)
        throw InputError("the matrix of vertices has " + std::to_string(rows) + " rows: " + std::to_string(most) +
                         " are the most");
}

void require_face_shape(Eigen::Index rows, Eigen::Index columns)
{
    if (rows == 0)
        return;
    if (columns < 3)
        throw InputError("the matrix of faces is " + shape(rows, columns) +
                         ": it must have 3 columns or more, and a row per face");
    if (rows > most / columns)
        throw InputError("the matrix of faces is " + shape(rows, columns) + ": " + std::to_string(most) +
                         " corners are the most");
}

}  // namespace seamflow
