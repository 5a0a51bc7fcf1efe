#pragma once

#include <concepts>
#include <type_traits>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A mesh of OpenMesh: OpenMesh::PolyMesh_ArrayKernelT or TriMesh_ArrayKernelT with any traits. This header includes
/// nothing of OpenMesh; code with such a mesh has included it already.
template <class Mesh>
concept OpenMeshMesh = requires(Mesh& mesh, const Mesh& constant, typename Mesh::VertexHandle v,
                                typename Mesh::FaceHandle f, typename Mesh::Point point)
{
    {
        constant.n_vertices()
        } -> std::convertible_to<std::size_t>;
    constant.vertices();
    constant.faces();
    constant.fv_range(f);
    {
        v.idx()
        } -> std::convertible_to<int>;
    point[0];
    constant.point(v);
    mesh.set_point(v, point);
};

/// A copy of an OpenMesh mesh, without the elements that are marked as deleted.
template <OpenMeshMesh Mesh>
PolygonMesh to_polygon_mesh(const Mesh& source)
{
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(source.n_vertices()), 3);
    std::vector<Index> number(source.n_vertices(), -1);
    Index count = 0;
    for (const auto v : source.vertices()) {
        for (int c = 0; c < 3; ++c)
            mesh.vertices(count, c) = static_cast<double>(source.point(v)[static_cast<unsigned>(c)]);
        number[v.idx()] = count++;
    }
    mesh.vertices.conservativeResize(count, 3);
    std::vector<Index> corners;
    for (const auto f : source.faces()) {
        corners.clear();
        for (const auto v : source.fv_range(f))
            corners.push_back(number[v.idx()]);
        mesh.add_face(corners);
    }
    return mesh;
}

/// The vertices of an OpenMesh mesh that its status bits fix, with the meaning that OpenMesh's own smoothers give them:
/// locked vertices and, if any vertex is selected, all unselected ones. Numbered like the rows of to_polygon_mesh.
/// Empty if the mesh has no vertex status.
template <OpenMeshMesh Mesh>
std::vector<Index> held_by_status(const Mesh& mesh)
{
    std::vector<Index> held;
    if constexpr (requires(typename Mesh::VertexHandle v) { mesh.status(v).locked(), mesh.has_vertex_status(); }) {
        if (!mesh.has_vertex_status())
            return held;
        bool any_selected = false;
        for (const auto v : mesh.vertices())
            any_selected = any_selected || mesh.status(v).selected();
        Index row = 0;
        for (const auto v : mesh.vertices()) {
            if (mesh.status(v).locked() || (any_selected && !mesh.status(v).selected()))
                held.push_back(row);
            ++row;
        }
    }
    return held;
}

/// Sets the positions of the vertices of an OpenMesh mesh.
/// @param positions one row per vertex that is not marked as deleted, in the mesh's order; rounded to the mesh's own
/// scalar.
template <OpenMeshMesh Mesh>
void set_positions(Mesh& mesh, const Points& positions)
{
    using Scalar = std::remove_cvref_t<decltype(typename Mesh::Point()[0])>;
    Index row = 0;
    for (const auto v : mesh.vertices()) {
        typename Mesh::Point point;
        for (int c = 0; c < 3; ++c)
            point[static_cast<unsigned>(c)] = static_cast<Scalar>(positions(row, c));
        mesh.set_point(v, point);
        ++row;
    }
}

}  // namespace seamflow
