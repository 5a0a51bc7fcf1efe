#include <atomic>
#include <chrono>
#include <random>
#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>

#include "engine/tasks/progress.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"

using namespace seamflow;

namespace {

PolygonMesh small_mesh()
{
    return make_mixed_polygons(600);
}

/// What an observer has been told.
struct Told {
    std::vector<FlowProgress> all;
    std::atomic<int> at_once = 0;
    bool overlapped = false;

    FlowControl control()
    {
        return {.stop = {}, .on_progress = [this](const FlowProgress& progress) {
                    overlapped = overlapped || ++at_once > 1;
                    all.push_back(progress);
                    std::this_thread::yield();
                    --at_once;
                }};
    }
};

/// The states of a flow: before it and after each of its steps.
std::vector<Points> states_of(PolygonMesh mesh, const AllOptions& options)
{
    std::vector<Points> states{mesh.vertices};
    smooth_surface(mesh, options, [&](const StepState& state) { states.push_back(state.positions); });
    return states;
}

}  // namespace

TEST_CASE("progress goes from 0 to 1 and never back, one call at a time, and changes no bit")
{
    const PolygonMesh mesh = small_mesh();
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        const AllOptions& options = kind.options;
        CAPTURE(kind.name);
        Told told;
        PolygonMesh moved = mesh;
        smooth_surface(moved, options, {}, told.control());
        CHECK(test::same_bits(moved.vertices, test::flowed(mesh, options)));
        CHECK_FALSE(told.overlapped);
        REQUIRE(told.all.size() >= 7);
        CHECK(told.all.front().fraction == 0.0);
        CHECK(told.all.back().fraction == 1.0);
        int steps_begun = 0;
        int within_steps = 0;
        for (std::size_t i = 1; i < told.all.size(); ++i) {
            const FlowProgress& before = told.all[i - 1];
            const FlowProgress& now = told.all[i];
            CHECK(now.fraction >= before.fraction);
            CHECK(now.step >= before.step);
            CHECK(now.steps == 4);
            steps_begun += now.step > before.step ? 1 : 0;
            within_steps += now.step == before.step && now.phase == FlowPhase::Step ? 1 : 0;
        }
        CHECK(steps_begun == 4);
        CHECK(within_steps >= 4);
    }
}

TEST_CASE("progress does not go back where a phase begins before the end of the one before it")
{
    Told told;
    const FlowControl control = told.control();
    Progress progress(control);
    progress.enter(FlowPhase::Cut, 0, 0.0, 0.5);
    progress.count();
    progress.enter(FlowPhase::Step, 1, 0.25, 0.75);
    progress.count();
    progress.finish();
    std::vector<double> fractions;
    for (const FlowProgress& now : told.all)
        fractions.push_back(now.fraction);
    CHECK(fractions == std::vector<double>{0.0, 0.5, 0.5, 0.75, 1.0});
}

TEST_CASE("progress is told some hundred times at most, however many steps there are")
{
    PolygonMesh mesh = make_quads(100);
    AllOptions options;
    options.time_step = 1e-6;
    options.steps = 3000;
    options.cut.subdomains = 4;
    Told told;
    smooth_surface(mesh, options, {}, told.control());
    CHECK(told.all.size() > 400);
    CHECK(told.all.size() < 2 * 3000);
}

TEST_CASE("stopped at any call of the observer, the mesh has the last complete step, and a new flow is as ever")
{
    const PolygonMesh mesh = small_mesh();
    std::mt19937 random(1);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        const AllOptions& options = kind.options;
        CAPTURE(kind.name);
        const std::vector<Points> states = states_of(mesh, options);
        Told told;
        PolygonMesh moved = mesh;
        smooth_surface(moved, options, {}, told.control());
        std::size_t n_calls = told.all.size();
        for (std::size_t call = 0; call + 1 < n_calls; call += 1 + random() % (n_calls / 12 + 1)) {
            std::stop_source source;
            std::size_t calls = 0;
            int steps_done = 0;
            PolygonMesh stopped = mesh;
            const FlowControl control{.stop = source.get_token(), .on_progress = [&](const FlowProgress&) {
                                          if (calls++ == call)
                                              source.request_stop();
                                      }};
            bool cancelled = false;
            try {
                smooth_surface(
                    stopped, options, [&](const StepState& state) { steps_done = state.step; }, control);
            } catch (const Cancelled&) {
                cancelled = true;
            }
            CHECK((cancelled || steps_done == options.steps));
            CHECK(test::same_bits(stopped.vertices, states[static_cast<std::size_t>(steps_done)]));
        }
        CHECK(test::same_bits(test::flowed(mesh, options), states.back()));
    }
}

TEST_CASE("stopped from another thread at any time, the mesh has the last complete step")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    std::mt19937 random(2);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        const AllOptions& options = kind.options;
        CAPTURE(kind.name);
        const auto start = std::chrono::steady_clock::now();
        const std::vector<Points> states = states_of(mesh, options);
        const auto all = std::chrono::steady_clock::now() - start;
        for (int attempt = 0; attempt < 4; ++attempt) {
            std::stop_source source;
            std::jthread other([&, delay = all * (random() % 1000) / 1000] {
                std::this_thread::sleep_for(delay);
                source.request_stop();
            });
            int steps_done = 0;
            PolygonMesh stopped = mesh;
            try {
                smooth_surface(stopped, options, [&](const StepState& state) { steps_done = state.step; },
                               {.stop = source.get_token()});
                CHECK(steps_done == options.steps);
            } catch (const Cancelled&) {
            }
            CHECK(test::same_bits(stopped.vertices, states[static_cast<std::size_t>(steps_done)]));
        }
    }
}

TEST_CASE("a flow that is to stop before it begins does nothing; one that has ended is not cancelled")
{
    std::stop_source source;
    PolygonMesh mesh = small_mesh();
    AllOptions options;
    options.time_step = 1e-3;
    CHECK_NOTHROW(
        smooth_surface(mesh, options, [&](const StepState&) { source.request_stop(); }, {.stop = source.get_token()}));
    const Points before = mesh.vertices;
    CHECK_THROWS_AS(smooth_surface(mesh, options, {}, {.stop = source.get_token()}), Cancelled);
    CHECK(test::same_bits(mesh.vertices, before));
}

TEST_CASE("what the observer throws ends the flow, from a task, too")
{
    const PolygonMesh mesh = small_mesh();
    AllOptions options;
    options.time_step = 1e-3;
    options.cut.subdomains = 8;
    for (const int last : {0, 3, 9, 20}) {
        PolygonMesh moved = mesh;
        int calls = 0;
        const auto fail = [&](const FlowProgress&) {
            if (calls++ == last)
                throw std::length_error("enough");
        };
        CHECK_THROWS_AS(smooth_surface(moved, options, {}, {.stop = {}, .on_progress = fail}), std::length_error);
    }
}
