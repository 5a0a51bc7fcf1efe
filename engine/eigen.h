#pragma once

#include <concepts>
#include <span>

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "partition/eigen.h"

namespace seamflow {

/// Calls move(mesh), and then copies the positions of the mesh to `vertices`, also after an exception.
template <class Vertices, class Move>
auto move_matrix(Eigen::MatrixBase<Vertices>& vertices, PolygonMesh mesh, Move&& move)
{
    try {
        auto report = move(mesh);
        set_positions(vertices, mesh.vertices);
        return report;
    } catch (...) {
        set_positions(vertices, mesh.vertices);
        throw;
    }
}

/// Smooths a mesh in matrices of Eigen, as in libigl: see mean_curvature_flow for a PolygonMesh. Positions are computed
/// in double precision, whatever the matrix's scalar type, and rounded once at the end.
/// @param vertices #V by 3, in any storage order: a matrix, a map or a block; its rows are moved; after an exception
///        they are those of the last complete step.
/// @param faces #F by 3 for triangles, #F by 4 for quads, #F by n: the vertices of a face in order, from 0; of any
///        integer type.
/// @throws InputError also for matrices of another shape, and for a vertex that does not exist, naming row and column.
template <class Vertices, class Faces>
requires std::integral<typename Faces::Scalar> FlowReport mean_curvature_flow(Eigen::MatrixBase<Vertices>& vertices,
                                                                              const Eigen::MatrixBase<Faces>& faces,
                                                                              const FlowOptions& options,
                                                                              const StepObserver& on_step = {},
                                                                              const FlowControl& control = {})
{
    return move_matrix(vertices, to_polygon_mesh(vertices, faces),
                       [&](PolygonMesh& mesh) { return mean_curvature_flow(mesh, options, on_step, control); });
}

/// Smooths a mesh of faces with any numbers of sides: see mean_curvature_flow for a matrix of faces.
/// @param vertices #V by 3, in any storage order; its rows are moved.
/// @param face_offsets #F + 1; the vertices of face f are face_vertices[face_offsets[f]] to
///        face_vertices[face_offsets[f + 1] - 1].
/// @param face_vertices one entry per corner of every face, in order around the face.
template <class Vertices>
requires std::floating_point<typename Vertices::Scalar>
    FlowReport mean_curvature_flow(Eigen::MatrixBase<Vertices>& vertices, std::span<const Index> face_offsets,
                                   std::span<const Index> face_vertices, const FlowOptions& options,
                                   const StepObserver& on_step = {}, const FlowControl& control = {})
{
    return move_matrix(vertices, to_polygon_mesh(vertices, face_offsets, face_vertices),
                       [&](PolygonMesh& mesh) { return mean_curvature_flow(mesh, options, on_step, control); });
}

/// Removes the noise of a mesh in matrices of Eigen: see denoise for a PolygonMesh, and mean_curvature_flow for the
/// matrices.
template <class Vertices, class Faces>
requires std::integral<typename Faces::Scalar> DenoiseReport denoise(Eigen::MatrixBase<Vertices>& vertices,
                                                                     const Eigen::MatrixBase<Faces>& faces,
                                                                     const DenoiseOptions& options = {},
                                                                     const StepObserver& on_step = {},
                                                                     const FlowControl& control = {})
{
    return move_matrix(vertices, to_polygon_mesh(vertices, faces),
                       [&](PolygonMesh& mesh) { return denoise(mesh, options, on_step, control); });
}

/// Removes the noise of a mesh of faces with any numbers of sides: see denoise for a matrix of faces.
template <class Vertices>
requires std::floating_point<typename Vertices::Scalar>
    DenoiseReport denoise(Eigen::MatrixBase<Vertices>& vertices, std::span<const Index> face_offsets,
                          std::span<const Index> face_vertices, const DenoiseOptions& options = {},
                          const StepObserver& on_step = {}, const FlowControl& control = {})
{
    return move_matrix(vertices, to_polygon_mesh(vertices, face_offsets, face_vertices),
                       [&](PolygonMesh& mesh) { return denoise(mesh, options, on_step, control); });
}

}  // namespace seamflow
