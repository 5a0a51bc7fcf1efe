// Side by side: the undecomposed flow, one sweep over the sub-meshes for each step, and converged steps.
//
//     converged_step INPUT SUBDOMAINS

#include <cstdlib>
#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>

namespace {

/// The positions after the flow, and the time that a step took.
seamflow::Points flow(seamflow::PolygonMesh mesh, const seamflow::FlowOptions& options, const char* name)
{
    const seamflow::FlowReport report = seamflow::mean_curvature_flow(mesh, options);
    std::cout << name << ": " << report.cut.n_sub_meshes() << " sub-meshes, " << report.seconds.step / options.steps
              << " s a step";
    return mesh.vertices;
}

}  // namespace

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::cerr << "usage: converged_step INPUT SUBDOMAINS\n";
        return 2;
    }
    const seamflow::PolygonMesh mesh = seamflow::read_mesh(argv[1]).mesh;
    const double edge = seamflow::mean_edge_length(mesh);
    seamflow::FlowOptions options;
    options.time_step = 5.0 * edge * edge;
    options.steps = 3;

    options.cut.subdomains = 1;
    const seamflow::Points undecomposed = flow(mesh, options, "undecomposed");
    std::cout << '\n';
    const auto print_distance = [&](const seamflow::Points& positions) {
        std::cout << ", V_max " << seamflow::vertex_distance(mesh, undecomposed, positions).max / edge << '\n';
    };

    options.cut.subdomains = std::atoi(argv[2]);
    options.accuracy.approach = seamflow::Approach::Sweep;
    print_distance(flow(mesh, options, "sweeps"));

    options.accuracy.tolerance = 1e-8;  // in place of a sweep
    print_distance(flow(mesh, options, "converged"));
} catch (const std::exception& error) {
    std::cerr << "converged_step: " << error.what() << '\n';
    return 1;
}
