#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <doctest/doctest.h>

#include "engine/steppers/sub_mesh_state.h"
#include "engine/steppers/sweep_order.h"
#include "partition/cut/cut.h"
#include "partition/decomposition/overlap.h"
#include "partition/decomposition/separated_sub_meshes.h"
#include "samples/meshes/meshes.h"
#include "solvers/conditions/adapted_robin.h"
#include "tests/support/flows.h"
#include "tests/support/heap.h"

using namespace seamflow;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A decomposed flow in which every sub-mesh knows its own vertices alone, until a transfer tells it more: what several
/// machines would have.
class Machines {
  public:
    Machines(const PolygonMesh& mesh, const FlowOptions& options)
        : options_(options)
        , mesh_(mesh)
        , topology_(make_topology(mesh))
        , cut_(cut_into(mesh, topology_, options.cut.subdomains))
        , decomposition_(decompose(mesh, topology_, cut_.labels, cut_.n_parts))
    {
        const std::vector<double> no_curvature(decomposition_.sub_meshes.size(), 0.0);
        const auto rank = assign_stages(decomposition_.adjacency, options.interface.colouring, no_curvature);
        if (options.interface.conditions == Conditions::Schwarz)
            grow_sub_meshes(mesh, rank);
        else
            plan_ = mutual() ? plan_mutual_sweep(decomposition_, rank) : plan_sweep(decomposition_, rank);
        for (const SubMesh& sub_mesh : decomposition_.sub_meshes) {
            SubMeshState& state =
                states_.emplace_back(sub_mesh, system_for(sub_mesh, options), mesh.vertices, predicts(options));
            state.p = options.interface.p ? *options.interface.p : 0.7 / std::sqrt(options.time_step);
        }
    }

    /// One step, sub-mesh after sub-mesh in the order of the colours.
    void step()
    {
        for (Index s = 0; s < n(); ++s) {
            forget_others(s);
            states_[s].solved.setConstant(unknown);
        }
        for (Index s = 0; s < n(); ++s)
            assemble_and_factorise(states_, s, decomposition_.halo[s], plan_, options_.time_step, test::heap(),
                                   workspace_);
        if (options_.interface.conditions == Conditions::AdaptedRobin)
            exchange_predictions();
        for (Index stage = 0; stage < n(); ++stage)
            for (Index s = 0; s < n(); ++s)
                if (plan_.stage[s] == stage)
                    solve(states_, s, decomposition_.halo[s], plan_, workspace_);
        for (Index s = 0; s < n(); ++s)
            options_.interface.correction == Correction::None || mutual()
                ? accept(states_[s])
                : accept_corrected(states_, s, decomposition_.halo[s]);
    }

    /// Checks that sub-meshes that were kept apart have the same bits.
    void check_separated(const PolygonMesh& separated) const
    {
        const SeparatedSubMeshes expected = separate(mesh_, decomposition_);
        REQUIRE(separated.face_vertices == expected.mesh.face_vertices);
        for_each_own([&](Index s, Index v) {
            CHECK(separated.vertices.row(expected.vertex_of[s][v]) == states_[s].position.row(v));
        });
    }

    /// The positions, #V by 3, from all sub-meshes; every copy of a vertex must have the same bits.
    [[nodiscard]] Points joined(Points positions) const
    {
        for_each_own([&](Index s, Index v) { positions.row(global(s, v)) = states_[s].position.row(v); });
        for_each_own([&](Index s, Index v) { CHECK(positions.row(global(s, v)) == states_[s].position.row(v)); });
        return positions;
    }

  private:
    void exchange_predictions()
    {
        for (Index s = 0; s < n(); ++s) {
            predict(states_[s], workspace_);
            states_[s].predicted.bottomRows(decomposition_.sub_meshes[s].n_halo).setConstant(unknown);
        }
        for (Index s = 0; s < n(); ++s)
            use_predictions(states_, s, plan_.predictions[s], workspace_);
    }

    [[nodiscard]] bool mutual() const { return is_classical(options_.interface.conditions); }

    std::unique_ptr<SubMeshSystem> system_for(const SubMesh& sub_mesh, const FlowOptions& options)
    {
        SystemParts parts{sub_mesh, sub_mesh.twin, options.laplacian};
        switch (options.interface.conditions) {
        case Conditions::Schwarz:
            return make_following_system(std::move(parts), workspace_);
        case Conditions::Robin:
            return make_system(std::move(parts), make_ventcell(sub_mesh), workspace_);
        case Conditions::Ventcell:
            return make_system(std::move(parts), make_ventcell(sub_mesh, options.interface.q.value()), workspace_);
        default:
            return make_predicted_system(std::move(parts), workspace_);
        }
    }

    [[nodiscard]] Index n() const { return cut_.n_parts; }
    [[nodiscard]] Index global(Index s, Index v) const { return decomposition_.sub_meshes[s].local_to_global[v]; }
    [[nodiscard]] bool is_own(Index s, Index v) const
    {
        const auto corners = topology_.corners_at(global(s, v));
        return std::any_of(corners.begin(), corners.end(),
                           [&](Index corner) { return cut_.labels[topology_.face_of[corner]] == s; });
    }
    template <class Action>
    void for_each_own(Action&& action) const
    {
        for (Index s = 0; s < n(); ++s)
            for (Index v = 0; v < decomposition_.sub_meshes[s].n_vertices; ++v)
                if (is_own(s, v))
                    action(s, v);
    }
    void forget_others(Index s)
    {
        Points& positions = states_[s].position;
        for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v)
            if (!is_own(s, v))
                positions.row(v).setConstant(unknown);
    }
    void grow_sub_meshes(const PolygonMesh& mesh, const std::vector<Index>& rank)
    {
        const Overlap overlap{cut_.labels, rank, options_.interface.overlap};
        std::vector<SubMesh> grown;
        for (Index s = 0; s < n(); ++s)
            grown.push_back(make_overlapping_sub_mesh(mesh, topology_, overlap, s, decomposition_.sub_meshes[s].faces));
        decomposition_ = connect_overlapping(std::move(grown), topology_, overlap);
        plan_ = plan_overlapping_sweep(decomposition_, rank);
    }

    SolverWorkspace workspace_;
    FlowOptions options_;
    PolygonMesh mesh_;
    Topology topology_;
    Cut cut_;
    Decomposition decomposition_;
    SweepPlan plan_;
    std::vector<SubMeshState> states_;
};

void compare_machines(const PolygonMesh& mesh, const FlowOptions& options)
{
    Machines machines(mesh, options);
    for (int step = 0; step < options.steps; ++step)
        machines.step();
    const Points expected = test::flowed(mesh, options);
    REQUIRE(expected.allFinite());
    CHECK(machines.joined(mesh.vertices) == expected);
}

FlowOptions fixed_sweep_options(Laplacian laplacian)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = 0.001;
    options.steps = 3;
    options.cut.subdomains = 7;
    options.interface.colouring = Colouring::Label;
    options.interface.sweep = Sweep::Fixed;
    return options;
}

std::vector<PolygonMesh> exchange_meshes()
{
    return {make_triangles(900), make_hexagons(900), make_mixed_polygons(900), make_noisy_sphere(900)};
}

}  // namespace

TEST_CASE("transfers carry all that crosses an interface: sub-meshes that know nothing else get the same bits")
{
    for (const PolygonMesh& mesh : exchange_meshes())
        for (const Laplacian laplacian : test::geometric_laplacians) {
            CAPTURE(name_of(laplacian));
            compare_machines(mesh, fixed_sweep_options(laplacian));
        }
}

TEST_CASE("the same holds for sub-meshes that overlap, corrected and not")
{
    for (const PolygonMesh& mesh : exchange_meshes())
        for (const Laplacian laplacian : test::geometric_laplacians)
            for (const Correction correction : {Correction::None, Correction::Centroid}) {
                CAPTURE(name_of(laplacian));
                FlowOptions options = fixed_sweep_options(laplacian);
                options.interface.conditions = Conditions::Schwarz;
                options.interface.overlap = 2;
                options.interface.correction = correction;
                compare_machines(mesh, options);
            }
}

TEST_CASE("the same holds where every sub-mesh keeps a copy of the interface of its own")
{
    for (PolygonMesh mesh : exchange_meshes())
        for (const Laplacian laplacian : test::geometric_laplacians)
            for (const Conditions conditions : {Conditions::Robin, Conditions::Ventcell}) {
                CAPTURE(name_of(laplacian));
                FlowOptions options = fixed_sweep_options(laplacian);
                options.interface.conditions = conditions;
                options.report.keep_gaps = true;
                options.interface.p = 0.7 / std::sqrt(options.time_step);
                if (conditions == Conditions::Ventcell)
                    options.interface.q = 0.3;
                Machines machines(mesh, options);
                for (int step = 0; step < options.steps; ++step)
                    machines.step();
                const FlowReport report = mean_curvature_flow(mesh, options);
                REQUIRE(report.separated);
                CHECK(report.steps.back().gap->max > 0.0);
                machines.check_separated(*report.separated);
            }
}
