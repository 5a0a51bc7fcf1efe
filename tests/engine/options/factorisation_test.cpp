#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

constexpr std::array all_factorisations{Factorisation::Automatic, Factorisation::Own, Factorisation::Cholmod,
                                        Factorisation::Umfpack};

FlowOptions sweeps_of(Laplacian laplacian, Factorisation factorisation)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.accuracy.approach = Approach::Sweep;
    options.time_step = 1e-3;
    options.steps = 2;
    options.cut.subdomains = 5;
    options.resources.factorisation = factorisation;
    return options;
}

/// Flows with each factorisation, whose results are to be those of the automatic one but for rounding.
template <class Check>
void compare_factorisations(const PolygonMesh& mesh, FlowOptions options, Check&& check)
{
    Points expected;
    for (const Factorisation factorisation : all_factorisations) {
        CAPTURE(static_cast<int>(factorisation));
        options.resources.factorisation = factorisation;
        if (!is_available(factorisation)) {
            PolygonMesh refused = mesh;
            CHECK_THROWS_WITH_AS(mean_curvature_flow(refused, options), doctest::Contains("SEAMFLOW_GPL=OFF"),
                                 OptionError);
            continue;
        }
        PolygonMesh flowing = mesh;
        const FlowReport report = mean_curvature_flow(flowing, options);
        if (factorisation == Factorisation::Automatic)
            expected = flowing.vertices;
        CHECK(test::largest_difference(flowing.vertices, expected) < 1e-9);
        check(factorisation, report);
    }
}

}  // namespace

TEST_CASE("sweeps have the same result with any factorisation")
{
    for (const Laplacian laplacian : test::all_laplacians) {
        CAPTURE(name_of(laplacian));
        const FlowOptions options = sweeps_of(laplacian, Factorisation::Automatic);
        compare_factorisations(make_noisy_sphere(900), options, [&](Factorisation asked, const FlowReport& report) {
            const bool is_general = laplacian == Laplacian::PtackovaVelho;
            CHECK(test::count_with(report.remarks, "not by CHOLMOD") ==
                  (asked == Factorisation::Cholmod && is_general ? 1 : 0));
            CHECK(test::count_with(report.remarks, "pivots from the diagonal") == 0);
        });
        compare_factorisations(make_quads(900), options, [](Factorisation, const FlowReport&) {});
    }
}

TEST_CASE("so have the undecomposed flow and those with other conditions")
{
    const PolygonMesh mesh = make_noisy_sphere(600);
    for (const Laplacian laplacian : test::all_laplacians) {
        CAPTURE(name_of(laplacian));
        FlowOptions options = sweeps_of(laplacian, Factorisation::Automatic);
        options.cut.subdomains = 1;
        compare_factorisations(mesh, options, [](Factorisation, const FlowReport&) {});
        options.cut.subdomains = 3;
        for (const Conditions conditions : {Conditions::Schwarz, Conditions::Robin}) {
            options.interface.conditions = conditions;
            compare_factorisations(mesh, options, [](Factorisation, const FlowReport&) {});
        }
    }
}

TEST_CASE("so has every flow equation, with and without prediction, attachment and filter")
{
    const PolygonMesh mesh = make_noisy_sphere(600);
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement})
        for (const FlowEquation equation : {FlowEquation::MeanCurvature, FlowEquation::Conformalized})
            for (const Transmission transmission : {Transmission::Predicted, Transmission::Derivative})
                for (const double attachment : {0.0, 50.0})
                    for (const Filter filter : {Filter::Diffusion, Filter::LowPass}) {
                        if (filter == Filter::LowPass && transmission == Transmission::Derivative)
                            continue;
                        CAPTURE(name_of(laplacian));
                        CAPTURE(static_cast<int>(equation));
                        CAPTURE(static_cast<int>(transmission));
                        CAPTURE(attachment);
                        CAPTURE(static_cast<int>(filter));
                        FlowOptions options = sweeps_of(laplacian, Factorisation::Automatic);
                        options.flow = equation;
                        options.interface.transmission = transmission;
                        options.motion.attachment = attachment;
                        options.filter = filter;
                        compare_factorisations(mesh, options, [](Factorisation, const FlowReport&) {});
                    }
}

TEST_CASE("every flow equation has one result, however its steps are solved")
{
    const PolygonMesh mesh = make_noisy_sphere(600);
    for (const FlowEquation equation : {FlowEquation::MeanCurvature, FlowEquation::Conformalized, FlowEquation::Linear})
        for (const double attachment : {0.0, 50.0}) {
            CAPTURE(static_cast<int>(equation));
            CAPTURE(attachment);
            FlowOptions options = sweeps_of(Laplacian::AlexaWardetzky, Factorisation::Automatic);
            options.flow = equation;
            options.motion.attachment = attachment;
            options.steps = 3;
            const auto flowed = [&](Approach approach, Factorisation factorisation) {
                options.accuracy.approach = approach;
                options.accuracy.tolerance =
                    approach == Approach::Undecomposed ? std::nullopt : std::optional<double>(1e-12);
                options.cut.subdomains = approach == Approach::Converged ? 4 : 0;
                options.resources.factorisation = factorisation;
                PolygonMesh flowing = mesh;
                mean_curvature_flow(flowing, options);
                return flowing.vertices;
            };
            const Points expected = flowed(Approach::Undecomposed, Factorisation::Own);
            CHECK(test::largest_difference(mesh.vertices, expected) > 1e-3);
            for (const Factorisation factorisation : {Factorisation::Cholmod, Factorisation::Umfpack})
                if (is_available(factorisation) && equation != FlowEquation::Linear)
                    CHECK(test::largest_difference(flowed(Approach::Undecomposed, factorisation), expected) < 1e-10);
            for (const Approach approach : {Approach::Converged, Approach::ConjugateGradients})
                if (approach == Approach::Converged || equation != FlowEquation::Conformalized)
                    CHECK(test::largest_difference(flowed(approach, Factorisation::Automatic), expected) < 1e-9);
        }
}

TEST_CASE("converged steps of Δ_P have any factorisation")
{
    FlowOptions options = sweeps_of(Laplacian::PtackovaVelho, Factorisation::Automatic);
    options.accuracy.approach = Approach::Automatic;
    options.accuracy.tolerance = 1e-11;
    compare_factorisations(make_noisy_sphere(600), options, [](Factorisation asked, const FlowReport& report) {
        CHECK(test::count_with(report.remarks, "not by CHOLMOD") == (asked == Factorisation::Cholmod ? 1 : 0));
    });
}

TEST_CASE(
    "converged steps of the other Laplacians refuse factorisations of other libraries, and are not chosen with them")
{
    const PolygonMesh mesh = make_noisy_sphere(3000);
    const auto run = [&](const FlowOptions& options) {
        PolygonMesh flowing = mesh;
        return mean_curvature_flow(flowing, options);
    };
    for (const Factorisation factorisation : all_factorisations) {
        CAPTURE(static_cast<int>(factorisation));
        if (!is_available(factorisation))
            continue;
        FlowOptions options = sweeps_of(Laplacian::Fujiwara, factorisation);
        options.steps = 1;
        options.accuracy.approach = Approach::Automatic;
        options.time_step = 20.0 * std::pow(mean_edge_length(mesh), 2);
        CHECK(run(options).convergence.tolerance.has_value() == !is_foreign(factorisation));
        options.accuracy.tolerance = 1e-3;
        if (is_foreign(factorisation))
            CHECK_THROWS_WITH_AS(run(options), doctest::Contains("Schur complements"), OptionError);
        else
            CHECK_NOTHROW(run(options));
    }
}
