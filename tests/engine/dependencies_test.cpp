#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/flow_plan.h"
#include "engine/sweep/factor_windows.h"
#include "engine/sweep/sub_mesh_equations.h"
#include "engine/sweep/sweep_order.h"
#include "partition/decomposition/overlap.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/laplacian.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/memory_limits.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// A task of one sweep by what it does for which sub-mesh.
using Task = std::pair<TaskKind, Index>;
/// What waits for what: the first of each pair comes before the second. In ascending order.
using Waits = std::vector<std::pair<Task, Task>>;

Waits ascending(Waits waits)
{
    std::ranges::sort(waits);
    return waits;
}

/// All tasks of one sweep, in ascending order.
std::vector<Task> tasks_of(const SweepPlan& plan, bool predicts)
{
    std::vector<Task> tasks;
    for (Index s = 0; s < static_cast<Index>(plan.stage.size()); ++s) {
        for (const TaskKind phase : {TaskKind::AssembleAndFactorise, TaskKind::Solve, TaskKind::Accept})
            tasks.emplace_back(phase, s);
        if (predicts && !plan.traces[s].empty())
            tasks.emplace_back(TaskKind::Predict, s);
        if (predicts && !plan.predictions[s].empty())
            tasks.emplace_back(TaskKind::UsePredictions, s);
    }
    std::ranges::sort(tasks);
    return tasks;
}

/// All that must wait in one sweep, by who takes what from whom.
Waits waits_of(const SweepPlan& plan, const std::vector<std::vector<Index>>& adjacency, const FactorWindow& window,
               bool predicts)
{
    const std::vector<Task> tasks = tasks_of(plan, predicts);
    const auto has = [&](TaskKind phase, Index s) { return std::ranges::binary_search(tasks, Task(phase, s)); };
    Waits waits;
    const auto add = [&](TaskKind before, Index s, TaskKind after, Index t) {
        waits.emplace_back(Task(before, s), Task(after, t));
    };
    for (Index s = 0; s < static_cast<Index>(plan.stage.size()); ++s) {
        add(TaskKind::AssembleAndFactorise, s, TaskKind::Solve, s);
        // Everyone around looks at the positions of before until it has solved, and at the solution to be corrected.
        add(TaskKind::Solve, s, TaskKind::Accept, s);
        for (const Index t : adjacency[s])
            add(TaskKind::Solve, t, TaskKind::Accept, s);
        for (const Transfer& trace : plan.traces[s])
            add(TaskKind::Solve, trace.from, TaskKind::Solve, s);
        for (const Transfer& copies : plan.copies[s])
            if (plan.stage[copies.from] < plan.stage[s])
                add(TaskKind::Solve, copies.from, TaskKind::Solve, s);
        for (const TaskKind phase : {TaskKind::Predict, TaskKind::UsePredictions})
            if (has(phase, s)) {
                add(TaskKind::AssembleAndFactorise, s, phase, s);
                add(phase, s, TaskKind::Solve, s);
            }
        if (has(TaskKind::Predict, s) && has(TaskKind::UsePredictions, s))
            add(TaskKind::Predict, s, TaskKind::UsePredictions, s);
        if (has(TaskKind::UsePredictions, s))
            for (const Transfer& prediction : plan.predictions[s])
                add(TaskKind::Predict, prediction.from, TaskKind::UsePredictions, s);
    }
    // A factor takes the place of one that is gone.
    for (std::size_t i = usize(window.size); i < window.order.size(); ++i)
        add(TaskKind::Solve, window.freed[i - usize(window.size)], TaskKind::AssembleAndFactorise, window.order[i]);
    return ascending(std::move(waits));
}

std::vector<Index> colours_of(const FlowReport& report)
{
    std::vector<Index> colours;
    for (const SubMeshReport& sub_mesh : report.cut.sub_meshes)
        colours.push_back(sub_mesh.colour);
    return colours;
}

/// The sub-meshes of a flow, cut out again.
Decomposition decomposed(const PolygonMesh& mesh, const FlowOptions& options, const FlowReport& report)
{
    const Topology topology = make_topology(mesh);
    if (options.interface.conditions != Conditions::Schwarz)
        return decompose(mesh, topology, report.cut.labels, report.cut.n_sub_meshes());
    const std::vector<Index> colours = colours_of(report);
    const Overlap overlap{report.cut.labels, colours, options.interface.overlap};
    auto faces = faces_by_label(report.cut.labels, report.cut.n_sub_meshes());
    std::vector<SubMesh> sub_meshes;
    for (Index s = 0; s < report.cut.n_sub_meshes(); ++s)
        sub_meshes.push_back(make_overlapping_sub_mesh(mesh, topology, overlap, s, std::move(faces[s])));
    return connect_overlapping(std::move(sub_meshes), topology, overlap);
}

/// What a flow has recorded of the tasks from `first` on, as many as there are in a sweep.
struct RecordedWaits {
    std::vector<Task> tasks;
    Waits waits;
};

RecordedWaits recorded_from(const Schedule& schedule, std::size_t first, std::size_t n)
{
    REQUIRE(first + n <= schedule.tasks.size());
    const auto task = [&](std::size_t i) { return Task(schedule.tasks[i].kind, schedule.tasks[i].sub_mesh); };
    const auto is_here = [&](Index i) { return usize(i) >= first && usize(i) < first + n; };
    RecordedWaits recorded;
    for (std::size_t i = first; i < first + n; ++i)
        recorded.tasks.push_back(task(i));
    std::ranges::sort(recorded.tasks);
    for (const auto& [before, after] : schedule.dependencies) {
        // Tasks of another sweep run in another step.
        CHECK(is_here(before) == is_here(after));
        if (is_here(before))
            recorded.waits.emplace_back(task(usize(before)), task(usize(after)));
    }
    std::ranges::sort(recorded.waits);
    return recorded;
}

std::string text_of(const Waits& waits)
{
    std::string text;
    for (const auto& [before, after] : waits)
        text += std::string(name_of(before.first)) + " " + std::to_string(before.second) + " before " +
                std::string(name_of(after.first)) + " " + std::to_string(after.second) + "\n";
    return text;
}

void check_same(const Waits& found, const Waits& expected)
{
    Waits missing;
    Waits superfluous;
    std::ranges::set_difference(expected, found, std::back_inserter(missing));
    std::ranges::set_difference(found, expected, std::back_inserter(superfluous));
    CHECK(text_of(missing) == "");
    CHECK(text_of(superfluous) == "");
}

/// One step of a mesh that does not matter, recorded by one thread, in which few factors live at once.
FlowOptions recorded_options(Index subdomains)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.time_step = 1e-6;
    options.cut.subdomains = subdomains;
    options.resources.threads = 1;
    options.accuracy.largest_update = std::numeric_limits<double>::infinity();
    options.report.record_schedule = true;
    return options;
}

/// Runs a step and compares its graphs with what they are made from.
/// @returns how many factors may live at once.
Index check_graphs(const PolygonMesh& mesh, const FlowOptions& options)
{
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, options);
    const Decomposition decomposition = decomposed(mesh, options, report);
    std::vector<std::vector<Index>> ranks{colours_of(report)};
    const SweepSteps sweeps = sweeps_of(options, report.cut.n_sub_meshes());
    if (sweeps.alternates)
        ranks.push_back(reversed(colours_of(report)));
    const std::vector<Index> order = reverse_cuthill_mckee(decomposition.adjacency);
    const Schedule& schedule = report.schedule.value();
    std::size_t first = 0;
    for (const std::vector<Index>& rank : ranks) {
        const SweepPlan plan = make_plan(decomposition, sweeps.conditions, rank);
        FactorWindow window = least_window(plan, order_by_need(plan, order));
        window.size = report.resources.live_factors;
        const std::vector<Task> tasks = tasks_of(plan, predict(sweeps.conditions));
        const RecordedWaits recorded = recorded_from(schedule, first, tasks.size());
        CHECK(recorded.tasks == tasks);
        check_same(recorded.waits, waits_of(plan, decomposition.adjacency, window, predict(sweeps.conditions)));
        first += tasks.size();
    }
    CHECK(first == schedule.tasks.size());
    return report.resources.live_factors;
}

std::vector<test::NamedMesh> meshes()
{
    return {test::named("triangles", make_triangles(1500)), test::named("mixed polygons", make_mixed_polygons(1500)),
            test::named("torus", test::quad_torus(40, 30)),
            test::named("two components", test::side_by_side({make_quads(700), make_noisy_sphere(500)}))};
}

}  // namespace

TEST_CASE("the graph of a sweep has the dependencies that plan, adjacency and window ask for, and no others")
{
    bool has_waited_for_room = false;
    for (const test::NamedMesh& mesh : meshes())
        for (const Index subdomains : {1, 2, 7, 40})
            for (const Conditions conditions :
                 {Conditions::AdaptedRobin, Conditions::AdaptedVentcell, Conditions::Robin, Conditions::Schwarz})
                for (const Transmission transmission : {Transmission::Predicted, Transmission::Derivative}) {
                    if (conditions != Conditions::AdaptedRobin && transmission == Transmission::Predicted)
                        continue;
                    CAPTURE(mesh.name);
                    CAPTURE(subdomains);
                    CAPTURE(static_cast<int>(conditions));
                    CAPTURE(static_cast<int>(transmission));
                    FlowOptions options = recorded_options(subdomains);
                    options.interface.conditions = conditions;
                    options.interface.transmission = transmission;
                    if (conditions == Conditions::AdaptedVentcell)
                        options.interface.q = 0.1;
                    has_waited_for_room |= check_graphs(mesh.mesh, options) < subdomains;
                }
    CHECK(has_waited_for_room);
}

TEST_CASE("so has that of sweeps in an order of their own, without correction, and with little memory")
{
    const PolygonMesh mesh = make_mixed_polygons(2000);
    for (const Laplacian laplacian : test::all_laplacians)
        for (const Sweep sweep : {Sweep::Fixed, Sweep::Alternating}) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = recorded_options(24);
            options.laplacian = laplacian;
            options.interface.sweep = sweep;
            options.interface.colouring = Colouring::Label;
            options.interface.correction = Correction::None;
            check_graphs(mesh, options);
        }
    FlowOptions options = recorded_options(24);
    const Index without_limit = check_graphs(mesh, options);
    options.resources.memory_limit = test::least_memory_limit(mesh, options);
    CHECK(check_graphs(mesh, options) < without_limit);
}

TEST_CASE("in converged steps the interface waits for all sub-meshes, and they for it")
{
    const PolygonMesh mesh = make_mixed_polygons(2000);
    for (const Laplacian laplacian : test::symmetric_laplacians) {
        CAPTURE(name_of(laplacian));
        FlowOptions options = recorded_options(12);
        options.laplacian = laplacian;
        options.accuracy.tolerance = 1e-2;
        PolygonMesh moved = mesh;
        const FlowReport report = mean_curvature_flow(moved, options);
        Waits expected;
        for (Index s = 0; s < report.cut.n_sub_meshes(); ++s) {
            expected.push_back({{TaskKind::Condense, s}, {TaskKind::SolveInterface, -1}});
            expected.push_back({{TaskKind::SolveInterface, -1}, {TaskKind::BackSubstitute, s}});
        }
        const Schedule& schedule = report.schedule.value();
        check_same(recorded_from(schedule, 0, schedule.tasks.size()).waits, ascending(std::move(expected)));
    }
}

TEST_CASE("converged steps whose factors do not all fit take turns, in both halves alike")
{
    const PolygonMesh mesh = make_mixed_polygons(2000);
    FlowOptions options = recorded_options(24);
    options.accuracy.tolerance = 1e-2;
    options.resources.threads = 2;
    PolygonMesh moved = mesh;
    options.resources.memory_limit = mean_curvature_flow(moved, options).resources.factor_memory_bytes * 6 / 10;
    const FlowReport report = mean_curvature_flow(moved, options);
    REQUIRE(report.resources.live_factors < report.cut.n_sub_meshes());
    const Schedule& schedule = report.schedule.value();
    std::vector<std::pair<Index, Index>> eliminated;
    std::vector<std::pair<Index, Index>> filled_in;
    for (const auto& [before, after] : recorded_from(schedule, 0, schedule.tasks.size()).waits)
        if (before.first == after.first)
            (before.first == TaskKind::Condense ? eliminated : filled_in).emplace_back(before.second, after.second);
    CHECK(eliminated == filled_in);
    // One less for each place, which somebody has first.
    CHECK(static_cast<Index>(eliminated.size()) == report.cut.n_sub_meshes() - report.resources.live_factors);
    // Nobody waits for two, nor lets two go.
    for (std::size_t i = 1; i < eliminated.size(); ++i) {
        CHECK(eliminated[i - 1].first < eliminated[i].first);
        CHECK(eliminated[i - 1].second < eliminated[i].second);
    }
}
