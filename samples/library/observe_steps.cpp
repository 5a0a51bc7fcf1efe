// Observes a mesh while it flows: prints the area after each step and writes every k-th state.
//
//     observe_steps INPUT OUTPUT_FOLDER STEPS K

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>
#include <seamflow/partition/vector_area.h>

namespace {

double area(const seamflow::PolygonMesh& mesh, const seamflow::Points& positions)
{
    double total = 0.0;
    for (seamflow::Index f = 0; f < mesh.n_faces(); ++f)
        total += seamflow::vector_area(mesh.face(f), positions).norm();
    return total;
}

}  // namespace

int main(int argc, char** argv)
try {
    if (argc != 5) {
        std::cerr << "usage: observe_steps INPUT OUTPUT_FOLDER STEPS K\n";
        return 2;
    }
    seamflow::MeshFile file = seamflow::read_mesh(argv[1]);
    const std::filesystem::path folder = argv[2];
    const std::string extension = std::filesystem::path(argv[1]).extension();
    const int every = std::max(std::atoi(argv[4]), 1);
    const double edge = seamflow::mean_edge_length(file.mesh);
    seamflow::FlowOptions options;
    options.time_step = edge * edge;
    options.steps = std::atoi(argv[3]);

    std::cout << "step 0: area " << area(file.mesh, file.mesh.vertices) << '\n';
    // Called in this thread; an exception thrown here ends the flow and reaches its caller.
    const auto on_step = [&](const seamflow::StepState& state) {
        std::cout << "step " << state.step << ": area " << area(file.mesh, state.positions) << ", moved by "
                  << state.report.displacement.normal.max / edge << " mean edges out of the surface at most\n";
        if (state.step % every != 0)
            return;
        seamflow::PolygonMesh now = file.mesh;
        now.vertices = state.positions;
        const auto path = folder / (std::to_string(state.step) + extension);
        seamflow::write_mesh(path, now, seamflow::kind_for_writing(path, file.kind));
    };
    seamflow::mean_curvature_flow(file.mesh, options, on_step);
} catch (const std::exception& error) {
    std::cerr << "observe_steps: " << error.what() << '\n';
    return 1;
}
