#pragma once

#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "partition/polygon_mesh.h"

namespace seamflow::test {

/// Double precision where OpenMesh has single by default.
struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using FloatPolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
using DoublePolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using FloatTriMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleTriMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// A mesh of OpenMesh with the same vertices and faces in the same order, rounded to its own scalar.
template <class Mesh>
Mesh openmesh_of(const PolygonMesh& source)
{
    using Scalar = typename Mesh::Scalar;
    Mesh mesh;
    for (Index v = 0; v < source.n_vertices(); ++v)
        mesh.add_vertex(typename Mesh::Point(static_cast<Scalar>(source.vertices(v, 0)),
                                             static_cast<Scalar>(source.vertices(v, 1)),
                                             static_cast<Scalar>(source.vertices(v, 2))));
    for (Index f = 0; f < source.n_faces(); ++f) {
        std::vector<typename Mesh::VertexHandle> corners;
        for (const Index v : source.face(f))
            corners.push_back(mesh.vertex_handle(static_cast<unsigned>(v)));
        mesh.add_face(corners);
    }
    return mesh;
}

}  // namespace seamflow::test
