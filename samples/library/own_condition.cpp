// The sweep of the paper with labels and a condition on Γ of one's own: Γ stays at Vᵏ, until it is corrected (eq. 28).
//
//     own_condition INPUT LABELS OUTPUT    (needs the sources of the library; LABELS: a number for each face)

#include <iostream>

#include "engine/sweep/sub_mesh_sweep.h"
#include "partition/cut/cut_into.h"
#include "partition/formats/index_files.h"
#include "partition/formats/mesh_io.h"
#include "partition/metrics/vertex_distance.h"

using namespace seamflow;

/// The rows V_v = V_v^k of all vertices v of Γ.
struct Dirichlet final : TransmissionCondition {
    explicit Dirichlet(const SubMesh& sub_mesh)
        : gamma(sub_mesh.interface.vertices)
        , own(make_lists<Index>(sub_mesh.interface.size(), [&](auto&& add) {
            for (Index i = 0; i < sub_mesh.interface.size(); ++i)
                add(i, sub_mesh.interface.vertices[i]);
        }))
    {
    }
    [[nodiscard]] const IndexLists& columns() const override { return own; }
    void begin_step(const Points&, const Points&, double, double) override {}
    void left_hand_side(Index, const Points&, std::span<double> row) const override { row[0] = 1.0; }
    [[nodiscard]] Point right_hand_side(Index i, const Points& before, const Points&) const override
    {
        return before.row(gamma[i]);
    }
    const std::vector<Index>& gamma;
    IndexLists own;
};

int main(int argc, char** argv)
try {
    if (argc != 4) {
        std::cerr << "usage: own_condition INPUT LABELS OUTPUT\n";
        return 2;
    }
    MeshFile file = read_mesh(argv[1]);
    const Topology topology = make_topology(file.mesh);
    const Cut cut = cut_by_labels(file.mesh, topology, read_labels(argv[2], file.mesh.n_faces()));
    StepSettings settings;
    settings.equation.time_step = mean_edge_length(file.mesh) * mean_edge_length(file.mesh);
    const SweepSteps steps{.conditions = OwnConditions{make_condition<Dirichlet>}, .corrects = true};
    const FlowControl control;
    Progress progress(control);
    Workspaces workspaces;
    SubMeshSweep sweep(file.mesh, cut_out(file.mesh, topology, cut, steps, {}, progress), settings, steps, workspaces,
                       progress);
    for (int step = 1; step <= 3; ++step)
        take_step(sweep, workspaces.local());
    file.mesh.vertices = sweep.positions();
    write_mesh_like(*file.source, argv[3], file.mesh);
} catch (const std::exception& error) {
    std::cerr << "own_condition: " << error.what() << '\n';
    return 1;
}
