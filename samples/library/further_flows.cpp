// One mesh, smoothed in six ways: by flows that are plain, with a low-pass filter, attached to where it was, and
// conformalized; between its sharp edges; and by removing its noise; and how far each moves it.
//
//     further_flows INPUT

#include <iostream>

#include <seamflow/engine/denoise.h>
#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>

int main(int argc, char** argv)
try {
    if (argc != 2) {
        std::cerr << "usage: further_flows INPUT\n";
        return 2;
    }
    const seamflow::PolygonMesh mesh = seamflow::read_mesh(argv[1]).mesh;
    const double edge = seamflow::mean_edge_length(mesh);
    const auto print = [&](const char* name, const seamflow::PolygonMesh& smooth) {
        std::cout << name << ": moved by "
                  << seamflow::vertex_distance(mesh, mesh.vertices, smooth.vertices).mean / edge << " mean edges\n";
    };
    const auto flow = [&](const char* name, auto change) {
        seamflow::FlowOptions options;
        options.laplacian = seamflow::Laplacian::VirtualRefinement;
        options.time_step = 5.0 * edge * edge;
        options.steps = 3;
        change(options);
        seamflow::PolygonMesh smooth = mesh;
        seamflow::mean_curvature_flow(smooth, options);
        print(name, smooth);
    };
    using Options = seamflow::FlowOptions;
    flow("plain", [](Options&) {});
    flow("low-pass", [](Options& options) { options.filter = seamflow::Filter::LowPass; });
    flow("attached", [&](Options& options) { options.motion.attachment = 1.0 / (9.0 * edge * edge); });
    flow("conformalized", [](Options& options) { options.flow = seamflow::FlowEquation::Conformalized; });
    // This needs no Laplacian; the angle is in degrees.
    const seamflow::SmoothBetweenEdges between{.edge_angle = 30.0, .amount = {.time_step = 5.0 * edge * edge}};
    seamflow::PolygonMesh smooth = mesh;
    seamflow::denoise(smooth, {.method = between, .steps = 3});
    print("edges kept", smooth);
    // What the program does without an option; a mesh without noise stays unchanged.
    smooth = mesh;
    seamflow::denoise(smooth);
    print("its noise removed", smooth);
} catch (const std::exception& error) {
    std::cerr << "further_flows: " << error.what() << '\n';
    return 1;
}
