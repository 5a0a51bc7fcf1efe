#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index.h"

namespace seamflow {

/// Positions, #V by 3, one vertex a row, in the unit of length of the input.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One position or vector, a row of Points.
using Point = Eigen::RowVector3d;

/// A polygonal surface mesh as flat arrays: faces of any number of sides, planar or not, convex or not. Vertices
/// without faces, several components, closed and open surfaces are all allowed, and faces need not be oriented alike.
struct PolygonMesh {
    /// #V by 3.
    Points vertices = Points(0, 3);
    /// #F + 1; the vertices of face f are face_vertices[face_offsets[f]] to face_vertices[face_offsets[f + 1] - 1].
    std::vector<Index> face_offsets{0};
    /// One entry per corner of every face, in order around the face.
    std::vector<Index> face_vertices;

    [[nodiscard]] Index n_vertices() const { return static_cast<Index>(vertices.rows()); }
    [[nodiscard]] Index n_faces() const { return static_cast<Index>(face_offsets.size()) - 1; }
    [[nodiscard]] Index n_corners() const { return static_cast<Index>(face_vertices.size()); }

    /// The vertices of face f, in order.
    [[nodiscard]] std::span<const Index> face(Index f) const
    {
        const std::size_t begin = usize(face_offsets[f]);
        return std::span<const Index>(face_vertices).subspan(begin, usize(face_offsets[f + 1]) - begin);
    }

    /// Appends a face.
    void add_face(std::span<const Index> corners)
    {
        face_vertices.insert(face_vertices.end(), corners.begin(), corners.end());
        face_offsets.push_back(n_corners());
    }
};

/// Checks that the arrays fit together, that every face has at least three corners, all different and in range, and
/// that all coordinates are finite.
/// @throws InputError naming the first offending face or vertex (numbered from 0).
void require_valid(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// #V: 1 for each vertex that a face uses, 0 for other vertices.
/// @pre every vertex named by a face exists.
std::vector<std::uint8_t> used_by_faces(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// #V by 3, uninitialised, in large pages where the system has them.
Points uninitialised_points(Index n);

/// Copies `from` to `to`.
/// @param from, to #V by 3.
void copy(const Executor& exec, const Points& from, Points& to);

}  // namespace seamflow
