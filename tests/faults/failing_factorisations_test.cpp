// Every numeric factorisation fails, alone or with all after it.

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "tests/faults/failing_work.h"
#include "tests/faults/small_runs.h"
#include "tests/support/collapsing_flow.h"

using namespace seamflow;
using After = test::FailingFactorisation::After;

namespace {

constexpr int n_steps = 2;

/// Runs a flow whose n-th factorisation fails.
/// @returns whether there was such a one.
bool fails_well(const AllOptions& options, int n, After after, int& n_complaints)
{
    PolygonMesh mesh = test::small_mesh();
    Points latest = mesh.vertices;
    int steps_done = 0;
    std::string message;
    const test::FailingFactorisation failing(n, after);
    try {
        smooth_surface(mesh, options, [&](const StepState& state) {
            steps_done = state.step;
            latest = state.positions;
        });
    } catch (const ComputationError& error) {
        message = error.what();
    }
    CAPTURE(message);
    CHECK(test::same_bits(mesh.vertices, latest));
    CHECK(mesh.vertices.allFinite());
    CHECK(message.empty() == (steps_done == n_steps));
    if (!message.empty()) {
        ++n_complaints;
        CHECK(message.starts_with("step " + std::to_string(steps_done + 1)));
        CHECK(message.find("sub-mesh ") != std::string::npos);
        CHECK(message.find("singular") != std::string::npos);
    }
    return failing.has_failed();
}

}  // namespace

TEST_CASE("a factorisation that fails is made up for, or comes out with its step and its sub-mesh")
{
    for (const test::FlowKind& kind : test::small_flows(n_steps, 2))
        for (const After after : {After::Works, After::Fails}) {
            CAPTURE(kind.name);
            int n_complaints = 0;
            int n = 1;
            while (fails_well(kind.options, n, after, n_complaints)) {
                ++n;
                REQUIRE(n < 1000);
            }
            // The matrix of a linear flow has one factorisation for all steps.
            CHECK((n > (kind.options.flow == FlowEquation::Linear ? 1 : 2) || !kind.factorises()));
            // The last system of all has another chance without responses, or with other pivots.
            if (after == After::Fails)
                CHECK((n_complaints > 0 || !kind.factorises()));
        }
}

TEST_CASE("conjugate gradients go without factors that fail")
{
    const PolygonMesh mesh = make_mixed_polygons(10'000);
    const AllOptions options = test::collapsing_flow(mesh);
    PolygonMesh moved = mesh;
    FlowReport report;
    {
        const test::FailingFactorisation failing(1, After::Fails);
        report = smooth_surface(moved, options);
        CHECK(failing.has_failed());
    }
    REQUIRE(report.choices.size() == 3);
    CHECK(sentence(report.choices.back()).find("there was none") != std::string::npos);
    AllOptions asked_for = options;
    asked_for.accuracy.approach = Approach::ConjugateGradients;
    CHECK(test::same_bits(moved.vertices, test::flowed(mesh, asked_for)));
}
