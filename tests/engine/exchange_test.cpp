#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "engine/sub_mesh_state.h"
#include "engine/sweep_order.h"
#include "partition/cut/cut.h"
#include "samples/common/meshes.h"
#include "solvers/conditions/predicted_side.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A decomposed flow in which every sub-mesh knows its own vertices alone, until a transfer tells it more: what several
/// machines would have.
class Machines {
  public:
    Machines(const PolygonMesh& mesh, const FlowOptions& options)
        : options_(options)
        , topology_(make_topology(mesh))
        , cut_(cut_into(mesh, topology_, options.subdomains))
        , decomposition_(decompose(mesh, topology_, cut_.labels, cut_.n_parts))
    {
        const std::vector<double> no_curvature(at(mesh.n_vertices()), 0.0);
        plan_ = plan_sweep(decomposition_, rank_sub_meshes(decomposition_, options.coloring, no_curvature));
        for (const SubMesh& sub_mesh : decomposition_.sub_meshes) {
            SubMeshState& state = states_.emplace_back(sub_mesh, options.laplacian,
                                                       make_predicted_side(sub_mesh, options.laplacian), mesh.vertices);
            state.p = 0.7 / std::sqrt(options.time_step);
            forget_halo(state.position, sub_mesh);
            state.solved.setConstant(unknown);
        }
    }

    /// One step, sub-mesh after sub-mesh in the order of the colours.
    void step()
    {
        for (Index s = 0; s < n(); ++s) {
            forget_halo(states_[at(s)].position, decomposition_.sub_meshes[at(s)]);
            states_[at(s)].solved.setConstant(unknown);
        }
        for (Index s = 0; s < n(); ++s)
            assemble_and_factorise(states_, s, decomposition_.halo[at(s)], plan_.roles[at(s)], options_.time_step);
        for (Index s = 0; s < n(); ++s) {
            predict(states_, s);
            forget_halo(states_[at(s)].predicted, decomposition_.sub_meshes[at(s)]);
        }
        for (Index s = 0; s < n(); ++s)
            use_predictions(states_, s, plan_.predictions[at(s)]);
        for (Index rank = 0; rank < n(); ++rank)
            for (Index s = 0; s < n(); ++s)
                if (plan_.rank[at(s)] == rank)
                    solve(states_, s, plan_.traces[at(s)]);
        for (Index s = 0; s < n(); ++s)
            accept_corrected(states_, s, decomposition_.halo[at(s)]);
    }

    /// The positions, #V by 3, from all sub-meshes; every copy of a vertex must have the same bits.
    [[nodiscard]] Points joined(Points positions) const
    {
        for (Index s = 0; s < n(); ++s)
            for (Index v = 0; v < decomposition_.sub_meshes[at(s)].n_vertices; ++v)
                positions.row(global(s, v)) = states_[at(s)].position.row(v);
        for (Index s = 0; s < n(); ++s)
            for (Index v = 0; v < decomposition_.sub_meshes[at(s)].n_vertices; ++v)
                CHECK(positions.row(global(s, v)) == states_[at(s)].position.row(v));
        return positions;
    }

  private:
    [[nodiscard]] Index n() const { return cut_.n_parts; }
    [[nodiscard]] Index global(Index s, Index v) const
    {
        return decomposition_.sub_meshes[at(s)].local_to_global[at(v)];
    }
    static void forget_halo(Points& positions, const SubMesh& sub_mesh)
    {
        positions.bottomRows(sub_mesh.n_halo).setConstant(unknown);
    }

    FlowOptions options_;
    Topology topology_;
    Cut cut_;
    Decomposition decomposition_;
    SweepPlan plan_;
    std::vector<SubMeshState> states_;
};

}  // namespace

TEST_CASE("transfers carry all that crosses an interface: sub-meshes that know nothing else get the same bits")
{
    for (const PolygonMesh& mesh :
         {make_triangles(900), make_hexagons(900), make_mixed_polygons(900), make_noisy_sphere(900)})
        for (const Laplacian laplacian : test::all_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options;
            options.laplacian = laplacian;
            options.time_step = 0.001;
            options.steps = 3;
            options.subdomains = 7;
            options.coloring = Coloring::Label;
            options.sweep = Sweep::Fixed;
            Machines machines(mesh, options);
            for (int step = 0; step < options.steps; ++step)
                machines.step();
            const Points expected = test::flowed(mesh, options);
            REQUIRE(expected.allFinite());
            CHECK(machines.joined(mesh.vertices) == expected);
        }
}
