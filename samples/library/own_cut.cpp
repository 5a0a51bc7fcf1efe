// A custom cut: the mesh is cut into slabs along its longest side, each a sub-mesh.
//
//     own_cut INPUT PARTS.ply SLABS

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>

namespace {

/// The slab of every face, by where its first vertex lies: #F.
std::vector<seamflow::Index> slabs(const seamflow::PolygonMesh& mesh, int n_slabs)
{
    const Eigen::RowVector3d low = mesh.vertices.colwise().minCoeff();
    const Eigen::RowVector3d size = mesh.vertices.colwise().maxCoeff() - low;
    Eigen::Index axis = 0;
    const double longest = size.maxCoeff(&axis);
    std::vector<seamflow::Index> labels;
    for (seamflow::Index f = 0; f < mesh.n_faces(); ++f) {
        const double place = (mesh.vertices(mesh.face(f).front(), axis) - low(axis)) / longest;
        labels.push_back(std::min(static_cast<seamflow::Index>(place * n_slabs), n_slabs - 1));
    }
    return labels;
}

}  // namespace

int main(int argc, char** argv)
try {
    if (argc != 4) {
        std::cerr << "usage: own_cut INPUT PARTS.ply SLABS\n";
        return 2;
    }
    seamflow::MeshFile file = seamflow::read_mesh(argv[1]);
    const double edge = seamflow::mean_edge_length(file.mesh);
    seamflow::FlowOptions options;
    options.time_step = edge * edge;
    options.cut.labels = slabs(file.mesh, std::atoi(argv[3]));
    const seamflow::FlowReport report = seamflow::mean_curvature_flow(file.mesh, options);
    // The parts as used: those not connected, or pinched at a vertex, have been repaired.
    seamflow::write_labelled_ply(argv[2], file.mesh, report.cut.labels);
    std::cout << report.cut.n_sub_meshes() << " sub-meshes, " << report.cut.interface_vertices
              << " vertices between them, " << report.cut.repaired_faces << " faces moved to another one\n";
} catch (const std::exception& error) {
    std::cerr << "own_cut: " << error.what() << '\n';
    return 1;
}
