#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/steppers/sweep_stepper.h"
#include "engine/sweep/sub_mesh_sweep.h"
#include "engine/tasks/workers.h"
#include "partition/cut/cut_into.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/conditions/adapted_robin.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

constexpr int n_steps = 4;

std::unique_ptr<TransmissionCondition> adapted_robin(const SubMesh& sub_mesh)
{
    return make_adapted_ventcell(sub_mesh, 0.0);
}

/// A mesh of polygons in nine sub-meshes, whose colours have an order of their own.
struct CutUp {
    PolygonMesh mesh = make_hexagons(900);
    Topology topology = make_topology(mesh);
    Cut cut = cut_into(mesh, topology, 9);
    std::vector<double> curvature = std::vector<double>(static_cast<std::size_t>(mesh.n_vertices()));
    FlowControl control;
    Progress progress{control};

    CutUp()
    {
        for (std::size_t v = 0; v < curvature.size(); ++v)
            curvature[v] = static_cast<double>(v % 7);
    }

    [[nodiscard]] StepSettings settings_with(Laplacian laplacian) const
    {
        const double edge = mean_edge_length(mesh);
        StepSettings settings;
        settings.equation.laplacian = laplacian;
        settings.equation.time_step = 3.0 * edge * edge;
        return settings;
    }

    /// The positions after steps one sub-mesh after the other.
    Points by_hand(const StepSettings& settings, const SweepSteps& steps)
    {
        Workspaces workspaces;
        SubMeshSweep sweep(mesh, cut_out(mesh, topology, cut, steps, curvature, progress), settings, steps, workspaces,
                           progress);
        for (int step = 0; step < n_steps; ++step) {
            sweep.set_plan(static_cast<std::size_t>(step) % sweep.plans().size());
            take_step(sweep, workspaces.local());
        }
        return sweep.positions();
    }

    /// The positions after steps in the graph of tasks.
    Points in_graph(const StepSettings& settings, const SweepSteps& steps)
    {
        SweepStepper stepper(mesh, topology, cut, settings, steps, curvature, progress);
        for (int step = 0; step < n_steps; ++step)
            stepper.step(Points(stepper.positions()));
        return stepper.positions();
    }
};

}  // namespace

TEST_CASE("the step of the paper, one sub-mesh after the other, has the bits of the graph of tasks")
{
    CutUp parts;
    const std::pair<const char*, InterfaceConditions> all_conditions[] = {
        {"predicted", PredictedTransmission{}},
        {"adapted", AdaptedConditions{.p = OptimalRobin{}, .q = 0.2}},
        {"classical", ClassicalConditions{.p = OptimalRobin{}}},
        {"Schwarz", SchwarzConditions{.overlap = 2}},
        {"own", OwnConditions{adapted_robin, OptimalRobin{}}}};
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
        for (const auto& [name, conditions] : all_conditions)
            for (const bool alternates : {false, true})
                for (const bool corrects : {false, true}) {
                    const std::string condition = name;
                    CAPTURE(condition);
                    CAPTURE(alternates);
                    CAPTURE(corrects);
                    // Sub-meshes that overlap do so for one order.
                    if (alternates && std::holds_alternative<SchwarzConditions>(conditions))
                        continue;
                    const SweepSteps steps{.conditions = conditions, .alternates = alternates, .corrects = corrects};
                    const StepSettings settings = parts.settings_with(laplacian);
                    const Points expected = parts.by_hand(settings, steps);
                    CHECK(!test::same_bits(expected, parts.mesh.vertices));
                    for (const int threads : {1, 3}) {
                        Points found;
                        Workers(threads).execute([&] { found = parts.in_graph(settings, steps); });
                        CHECK(test::same_bits(found, expected));
                    }
                }
}

TEST_CASE("conditions of a caller's own take the place of the built ones")
{
    CutUp parts;
    const StepSettings settings = parts.settings_with(Laplacian::Fujiwara);
    const auto after = [&](const InterfaceConditions& conditions) {
        return parts.by_hand(settings, {.conditions = conditions, .corrects = true});
    };
    const Points adapted = after(AdaptedConditions{.p = OptimalRobin{}});
    CHECK(test::same_bits(after(OwnConditions{adapted_robin, OptimalRobin{}}), adapted));
    // The parameter that the caller gives is the one that its rows get.
    CHECK(test::same_bits(after(OwnConditions{adapted_robin, 3.0}), after(AdaptedConditions{.p = 3.0})));
    CHECK(!test::same_bits(after(OwnConditions{adapted_robin, 3.0}), adapted));
}
