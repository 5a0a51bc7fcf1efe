#pragma once

#include <concepts>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "partition/errors.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Throws an InputError unless a matrix of vertices of this shape has three columns and no more rows than fit an Index.
void require_vertex_shape(Eigen::Index rows, Eigen::Index columns);

/// Throws an InputError unless a matrix of faces of this shape has at least three columns, or no rows, and no more
/// corners than fit an Index.
void require_face_shape(Eigen::Index rows, Eigen::Index columns);

/// Makes a mesh from a matrix of positions and flat arrays of faces.
/// @param vertices #V by 3, in any storage order, of any scalar.
/// @param face_offsets, face_vertices as in PolygonMesh.
/// @throws InputError for a matrix of another shape. Array content is checked later (see require_valid).
template <class Vertices>
PolygonMesh to_polygon_mesh(const Eigen::MatrixBase<Vertices>& vertices, std::span<const Index> face_offsets,
                            std::span<const Index> face_vertices)
{
    require_vertex_shape(vertices.rows(), vertices.cols());
    PolygonMesh mesh;
    mesh.vertices = vertices.template cast<double>();
    mesh.face_offsets.assign(face_offsets.begin(), face_offsets.end());
    mesh.face_vertices.assign(face_vertices.begin(), face_vertices.end());
    return mesh;
}

/// Makes a mesh from a matrix of positions and a matrix of faces that all have the same number of sides.
/// @param vertices #V by 3, in any storage order, of any scalar.
/// @param faces #F by 3 for triangles, #F by 4 for quads, #F by n: the vertices of a face in order, from 0; of any
///        integer type.
/// @throws InputError for a matrix of another shape, or naming row and column of a vertex out of range.
template <class Vertices, class Faces>
requires std::integral<typename Faces::Scalar> PolygonMesh to_polygon_mesh(const Eigen::MatrixBase<Vertices>& vertices,
                                                                           const Eigen::MatrixBase<Faces>& faces)
{
    constexpr Index no_faces[] = {0};
    PolygonMesh mesh = to_polygon_mesh(vertices, no_faces, {});
    require_face_shape(faces.rows(), faces.cols());
    mesh.face_offsets.reserve(static_cast<std::size_t>(faces.rows()) + 1);
    mesh.face_vertices.reserve(static_cast<std::size_t>(faces.size()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        for (Eigen::Index c = 0; c < faces.cols(); ++c) {
            const auto v = faces.derived().coeff(f, c);
            if (std::cmp_less(v, 0) || std::cmp_greater_equal(v, mesh.n_vertices()))
                throw InputError("faces(" + std::to_string(f) + ", " + std::to_string(c) + ") is " + std::to_string(v) +
                                 ", but the vertices are 0 to " + std::to_string(mesh.n_vertices() - 1));
            mesh.face_vertices.push_back(static_cast<Index>(v));
        }
        mesh.face_offsets.push_back(mesh.n_corners());
    }
    return mesh;
}

/// Gives the rows of a matrix new positions, rounded to its own scalar.
/// @param vertices, positions #V by 3.
template <class Vertices>
void set_positions(Eigen::MatrixBase<Vertices>& vertices, const Points& positions)
{
    vertices = positions.cast<typename Vertices::Scalar>();
}

}  // namespace seamflow
