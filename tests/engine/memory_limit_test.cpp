#include <limits>
#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/options/option_names.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/memory_limits.h"
#include "tests/support/messages.h"

using namespace seamflow;
using test::same_bits;

namespace {

FlowOptions limited_options(Conditions conditions, int threads = 1)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.interface.conditions = conditions;
    options.time_step = 0.001;
    options.steps = 3;
    options.cut.subdomains = 40;
    options.resources.threads = threads;
    // What comes out does not matter here; the classical conditions are rough with so many sub-meshes.
    options.accuracy.largest_update = std::numeric_limits<double>::infinity();
    return options;
}

FlowOptions limited_converged(Laplacian laplacian, int threads = 1)
{
    FlowOptions options = limited_options(Conditions::AdaptedRobin, threads);
    options.accuracy.approach = Approach::Automatic;
    options.laplacian = laplacian;
    options.accuracy.tolerance = 1e-8;
    return options;
}

/// The message with which a flow refuses this limit; empty if it does not.
std::string complaint_about(PolygonMesh mesh, FlowOptions options, std::size_t memory_limit)
{
    options.resources.memory_limit = memory_limit;
    return test::message_of<OptionError>([&] { mean_curvature_flow(mesh, options); });
}

std::size_t least_limit(const PolygonMesh& mesh, const FlowOptions& options)
{
    const auto least = test::least_memory_limit(mesh, options);
    REQUIRE(least);
    return *least;
}

}  // namespace

TEST_CASE("no limit changes a bit of the result, nor do threads")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Schwarz, Conditions::Robin}) {
        CAPTURE(static_cast<int>(conditions));
        const Points expected = test::flowed(mesh, limited_options(conditions));
        const std::size_t least = least_limit(mesh, limited_options(conditions));
        for (const int threads : {1, 4})
            for (const std::optional<std::size_t> limit :
                 {std::optional(least), std::optional(2 * least), std::optional<std::size_t>(),
                  std::optional(std::numeric_limits<std::size_t>::max())}) {
                FlowOptions options = limited_options(conditions, threads);
                options.resources.memory_limit = limit;
                CHECK(same_bits(test::flowed(mesh, options), expected));
            }
    }
}

TEST_CASE("factors keep to the limit, and there are as many at once as without it where it lets them be")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Schwarz, Conditions::Robin})
        for (const int threads : {1, 4}) {
            FlowOptions options = limited_options(conditions, threads);
            const std::size_t least = least_limit(mesh, options);
            PolygonMesh free = mesh;
            const Index enough = mean_curvature_flow(free, options).resources.live_factors;
            PolygonMesh narrow = mesh;
            options.resources.memory_limit = least;
            const FlowReport at_least = mean_curvature_flow(narrow, options);
            CHECK(at_least.resources.live_factors < enough);
            CHECK(at_least.resources.factor_memory_bytes <= least);
            PolygonMesh wide = mesh;
            options.resources.memory_limit = 2 * least;
            const FlowReport twice = mean_curvature_flow(wide, options);
            CHECK(twice.resources.live_factors == std::min(2 * at_least.resources.live_factors, enough));
            CHECK(twice.resources.factor_memory_bytes <= 2 * least);
            PolygonMesh boundless = mesh;
            options.resources.memory_limit = std::numeric_limits<std::size_t>::max();
            CHECK(mean_curvature_flow(boundless, options).resources.live_factors == enough);
        }
}

TEST_CASE("the report knows the memory that factors by Cholesky's method had")
{
    PolygonMesh mesh = make_mixed_polygons(3000);
    const FlowReport report = mean_curvature_flow(mesh, limited_options(Conditions::AdaptedRobin));
    CHECK(report.resources.factor_memory_bytes > 0);
    CHECK(report.resources.live_factors >= 1);
    CHECK(report.resources.live_factors <= report.cut.n_sub_meshes());
}

TEST_CASE("a limit below what a step needs at once is refused with both numbers")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const FlowOptions& options :
         {limited_options(Conditions::AdaptedRobin), limited_converged(Laplacian::Fujiwara)}) {
        const std::size_t least = least_limit(mesh, options);
        CHECK(complaint_about(mesh, options, least).empty());
        const std::string complaint = complaint_about(mesh, options, least - 1);
        CHECK(complaint.find("memory_limit is " + std::to_string(least - 1) + " bytes") != std::string::npos);
        CHECK(complaint.find("take " + std::to_string(least)) != std::string::npos);
        CHECK(complaint_about(mesh, options, 0).find("memory_limit is 0, but must be at least 1") != std::string::npos);
    }
}

TEST_CASE("the limit is for the sub-meshes, not for the undecomposed flow that they are held beside")
{
    PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options = limited_options(Conditions::AdaptedRobin);
    options.resources.memory_limit = least_limit(mesh, options);
    options.report.reference = true;
    CHECK(mean_curvature_flow(mesh, options).steps.back().distance->mean > 0.0);
}

TEST_CASE("converged steps keep to the limit, and what they make again changes no bit of the result")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
        for (const Precision precision : {Precision::Automatic, Precision::Single, Precision::Double}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(option_name(precision));
            FlowOptions options = limited_converged(laplacian);
            options.resources.precision = precision;
            PolygonMesh boundless = mesh;
            const FlowReport expected = mean_curvature_flow(boundless, options);
            CHECK(expected.resources.live_factors == expected.cut.n_sub_meshes());
            // Those that may be in either precision count as if they were in double precision.
            const std::size_t all =
                expected.resources.factor_memory_bytes * (precision == Precision::Automatic ? 2 : 1);
            const std::size_t least = least_limit(mesh, options);
            CHECK(2 * least < all);
            for (const int threads : {1, 4})
                for (const std::size_t limit : {least, 2 * least, (least + all) / 2, all - 1, all}) {
                    CAPTURE(limit);
                    options.resources.threads = threads;
                    options.resources.memory_limit = limit;
                    PolygonMesh limited = mesh;
                    const FlowReport report = mean_curvature_flow(limited, options);
                    CHECK(same_bits(limited.vertices, boundless.vertices));
                    CHECK(report.resources.factor_memory_bytes <= limit);
                    // Nothing stays but what has to.
                    if (limit == least)
                        CHECK(report.resources.factor_memory_bytes == least);
                    CHECK((report.resources.live_factors < report.cut.n_sub_meshes()) == (limit < all));
                    CHECK(report.steps.back().residual == expected.steps.back().residual);
                }
        }
}

TEST_CASE(
    "a limit that no factors fit into leaves the choice to conjugate gradients, and one that changes nothing to none")
{
    const PolygonMesh mesh = make_mixed_polygons(6000);
    for (const double step_edges : {2.0, 500.0}) {
        FlowOptions options;
        options.time_step = step_edges * mean_edge_length(mesh) * mean_edge_length(mesh);
        options.steps = 3;
        PolygonMesh free = mesh;
        const FlowReport of_free = mean_curvature_flow(free, options);
        options.resources.memory_limit = std::numeric_limits<std::size_t>::max();
        CHECK(same_bits(test::flowed(mesh, options), free.vertices));
        options.resources.memory_limit = 1;
        PolygonMesh lean = mesh;
        const FlowReport of_lean = mean_curvature_flow(lean, options);
        CHECK(of_lean.convergence.approach == Approach::ConjugateGradients);
        CHECK(of_lean.resources.factor_memory_bytes == 0);
        CHECK(of_lean.cut.n_sub_meshes() == 1);
        CHECK((lean.vertices - free.vertices).rowwise().norm().maxCoeff() < 0.1 * mean_edge_length(mesh));
        if (of_free.convergence.approach != Approach::ConjugateGradients)
            CHECK(sentence(of_lean.choices.front()).find("would exceed the memory limit") != std::string::npos);
    }
}

TEST_CASE("a flow that needs sub-meshes is refused, however little its limit is")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options = limited_options(Conditions::AdaptedRobin);
    CHECK_FALSE(complaint_about(mesh, options, 1).empty());
    options = FlowOptions();
    options.time_step = 1e-4;
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK_FALSE(complaint_about(mesh, options, 1).empty());
}
