// Takes steps of the linear flow, which have one factorisation, until the largest mean curvature is half of what it
// was.
//
//     step_by_step INPUT OUTPUT    (both of one format)

#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/formats/mesh_io.h>
#include <seamflow/partition/metrics/vertex_distance.h>

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::cerr << "usage: step_by_step INPUT OUTPUT\n";
        return 2;
    }
    seamflow::MeshFile file = seamflow::read_mesh(argv[1]);
    const double edge = seamflow::mean_edge_length(file.mesh);

    seamflow::FlowOptions options;
    options.flow = seamflow::FlowEquation::Linear;
    options.time_step = 0.1 * edge * edge;  // length²
    constexpr int most_steps = 100;
    options.steps = most_steps;
    seamflow::Flow flow(file.mesh, options);  // the mesh must outlive the flow
    for (bool is_smooth = false; !is_smooth && flow.n_steps() < most_steps;) {
        flow.step();
        const seamflow::FlowReport report = flow.report();
        const seamflow::StepReport& last = report.steps.back();
        std::cout << "step " << flow.n_steps() << ": mean curvature up to " << last.max_mean_curvature_after
                  << " / length, " << last.seconds << " s\n";
        is_smooth = 2.0 * last.max_mean_curvature_after <= report.steps.front().max_mean_curvature_before;
    }

    seamflow::write_mesh_like(*file.source, argv[2], file.mesh);
} catch (const std::exception& error) {
    std::cerr << "step_by_step: " << error.what() << '\n';
    return 1;
}
