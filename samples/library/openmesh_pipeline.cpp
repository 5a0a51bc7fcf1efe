// An OpenMesh pipeline: reads a mesh, smooths it in place, updates its normals, and writes it.
//
//     openmesh_pipeline INPUT OUTPUT

#include <cmath>
#include <iostream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <seamflow/engine/openmesh.h>

namespace {

struct DoublePrecision : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<DoublePrecision>;

double mean_edge_length(const Mesh& mesh)
{
    double total = 0.0;
    for (const auto edge : mesh.edges())
        total += mesh.calc_edge_length(edge);
    return total / static_cast<double>(mesh.n_edges());
}

}  // namespace

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::cerr << "usage: openmesh_pipeline INPUT OUTPUT\n";
        return 2;
    }
    Mesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, argv[1]) || mesh.n_faces() == 0)
        throw std::runtime_error(std::string("OpenMesh cannot read ") + argv[1]);

    seamflow::FlowOptions options;
    options.time_step = 3.0 * std::pow(mean_edge_length(mesh), 2);
    options.steps = 3;
    seamflow::mean_curvature_flow(mesh, options);  // moves the points, and nothing else of the mesh

    mesh.request_face_normals();
    mesh.request_vertex_normals();
    mesh.update_normals();
    if (!OpenMesh::IO::write_mesh(mesh, argv[2], OpenMesh::IO::Options::VertexNormal))
        throw std::runtime_error(std::string("OpenMesh cannot write ") + argv[2]);
    std::cout << mesh.n_vertices() << " vertices smoothed, written with normals\n";
} catch (const std::exception& error) {
    std::cerr << "openmesh_pipeline: " << error.what() << '\n';
    return 1;
}
