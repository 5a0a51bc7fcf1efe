// The library in ten lines: reads a mesh, smooths it, writes it with all other contents of its file.
//
//     library_call INPUT OUTPUT    (both of one format)

#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::cerr << "usage: library_call INPUT OUTPUT\n";
        return 2;
    }
    seamflow::MeshFile file = seamflow::read_mesh(argv[1]);
    const double edge = seamflow::mean_edge_length(file.mesh);

    seamflow::FlowOptions options;
    options.laplacian = seamflow::Laplacian::Fujiwara;
    options.time_step = 3.0 * edge * edge;  // length²: one step smooths over about √3 edges
    options.steps = 3;
    const seamflow::FlowReport report = seamflow::mean_curvature_flow(file.mesh, options);

    seamflow::write_mesh_like(*file.source, argv[2], file.mesh);
    std::cout << report.mesh.vertices << " vertices in " << report.cut.n_sub_meshes() << " sub-meshes, "
              << report.seconds.step / options.steps << " s a step\n";
} catch (const std::exception& error) {
    std::cerr << "library_call: " << error.what() << '\n';
    return 1;
}
