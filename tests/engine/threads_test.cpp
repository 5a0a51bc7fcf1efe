#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/option_cases.h"
#include "tests/support/outcome.h"

using namespace seamflow;
using test::same_bits;

namespace {

FlowOptions threaded_options(Laplacian laplacian, int threads)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = 0.001;
    options.steps = 3;
    options.cut.subdomains = 24;
    options.resources.threads = threads;
    return options;
}

void check_threads(const std::string& name, const PolygonMesh& mesh, AllOptions options)
{
    CAPTURE(name);
    options.resources.threads = 1;
    const test::Outcome expected = test::outcome_of(mesh, options);
    for (const int threads : {2, 3, 8}) {
        CAPTURE(threads);
        options.resources.threads = threads;
        const test::Outcome found = test::outcome_of(mesh, options);
        CHECK(found.message == expected.message);
        CHECK(same_bits(found.end, expected.end));
        if (!expected.message.empty())
            continue;
        CHECK(found.report.resources.threads == threads);
        CHECK(found.report.displacement.has_value() == expected.report.displacement.has_value());
        if (found.report.displacement)
            CHECK(found.report.displacement->drift.rms == expected.report.displacement->drift.rms);
        for (std::size_t i = 0; i < expected.report.steps.size(); ++i) {
            const StepReport& step = found.report.steps[i];
            const StepReport& other = expected.report.steps[i];
            CHECK(step.estimated_v_max == other.estimated_v_max);
            CHECK(step.displacement.tangential.mean == other.displacement.tangential.mean);
            CHECK(step.displacement.normal.rms == other.displacement.normal.rms);
        }
    }
}

}  // namespace

TEST_CASE("every kind of flow and every option give the same bits on any number of threads, junctions or not")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const PolygonMesh& any : {mesh, test::foam(14, 6, 5)})
        for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(any)))
            check_threads(kind.name, any, kind.options);
    const double edge = mean_edge_length(mesh);
    for (const test::OptionCase& option : test::option_cases()) {
        AllOptions options = test::options_without_cases(edge);
        option.set(options, mesh, edge);
        check_threads(option.name(), mesh, options);
    }
}

TEST_CASE("the observer is called in the thread that called the flow")
{
    PolygonMesh mesh = make_quads(400);
    const auto caller = std::this_thread::get_id();
    for (const int threads : {0, 1, 2, 5})
        mean_curvature_flow(mesh, threaded_options(Laplacian::Fujiwara, threads),
                            [&](const StepState&) { CHECK(std::this_thread::get_id() == caller); });
}

TEST_CASE("numbers of threads that no machine has are refused before any thread is made")
{
    for (const int threads : {-1, 1025, 65'536, 65'537, 2'147'483'647}) {
        CAPTURE(threads);
        const std::string expected =
            "threads is " + std::to_string(threads) +
            ", but must be at least 0 and at most 1024 (0: as many as the calling TBB arena has)";
        CHECK_THROWS_WITH_AS(Workers{threads}, expected.c_str(), OptionError);
        PolygonMesh mesh = make_triangles(100);
        CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, threaded_options(Laplacian::Fujiwara, threads)),
                             expected.c_str(), OptionError);
    }
    CHECK(Workers(1024).threads() >= 1);
}
