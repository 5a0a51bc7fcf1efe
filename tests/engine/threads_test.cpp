#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

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

}  // namespace

TEST_CASE("every number of threads from 1 to 8, and every repetition, gives the same bits")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(3000), make_noisy_sphere(3000)})
        for (const Laplacian laplacian : test::all_laplacians) {
            CAPTURE(name_of(laplacian));
            const Points expected = test::flowed(mesh, threaded_options(laplacian, 1));
            for (int threads = 1; threads <= 8; ++threads) {
                CAPTURE(threads);
                CHECK(same_bits(test::flowed(mesh, threaded_options(laplacian, threads)), expected));
            }
        }
}

TEST_CASE("the report says how many threads there were")
{
    PolygonMesh mesh = make_quads(400);
    CHECK(mean_curvature_flow(mesh, threaded_options(Laplacian::Fujiwara, 3)).resources.threads == 3);
}

TEST_CASE("without a number of its own the flow keeps to the caller's arena")
{
    PolygonMesh mesh = make_quads(400);
    oneapi::tbb::task_arena arena(1);
    const FlowReport report =
        arena.execute([&] { return mean_curvature_flow(mesh, threaded_options(Laplacian::Fujiwara, 0)); });
    CHECK(report.resources.threads == 1);
}

TEST_CASE("the observer is called in the thread that called the flow")
{
    PolygonMesh mesh = make_quads(400);
    const auto caller = std::this_thread::get_id();
    for (const int threads : {0, 1, 2, 5})
        mean_curvature_flow(mesh, threaded_options(Laplacian::Fujiwara, threads),
                            [&](const StepState&) { CHECK(std::this_thread::get_id() == caller); });
}

TEST_CASE("two flows at the same time do not disturb each other")
{
    const PolygonMesh mesh = make_mixed_polygons(2000);
    const Points expected = test::flowed(mesh, threaded_options(Laplacian::AlexaWardetzky, 1));
    Points first;
    Points second;
    std::thread other([&] { first = test::flowed(mesh, threaded_options(Laplacian::AlexaWardetzky, 2)); });
    second = test::flowed(mesh, threaded_options(Laplacian::AlexaWardetzky, 3));
    other.join();
    CHECK(same_bits(first, expected));
    CHECK(same_bits(second, expected));
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
