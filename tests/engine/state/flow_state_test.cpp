#include <limits>
#include <memory>

#include <doctest/doctest.h>

#include "engine/state/checkpoint.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

/// The result of a flow and what it reported.
struct Outcome {
    Points positions;
    FlowReport report;
};

Outcome run(PolygonMesh mesh, const FlowOptions& options, std::shared_ptr<const FlowState> resume = nullptr)
{
    FlowReport report = mean_curvature_flow(mesh, options, {}, {.stop = {}, .on_progress = {}, .resume = resume});
    return {mesh.vertices, std::move(report)};
}

/// The state after a step, by way of a file.
std::shared_ptr<const FlowState> state_after(int step, PolygonMesh mesh, FlowOptions options)
{
    const test::TemporaryDirectory directory;
    options.steps = step;
    mean_curvature_flow(mesh, options, [&](const StepState& state) {
        if (state.step == step)
            write_checkpoint(directory / "state", state.capture());
    });
    return std::make_shared<const FlowState>(read_checkpoint(directory / "state"));
}

void check_same(const LengthStatistics& a, const LengthStatistics& b)
{
    CHECK(a.mean == b.mean);
    CHECK(a.rms == b.rms);
    CHECK(a.max == b.max);
}

void check_same(const StepReport& a, const StepReport& b)
{
    CHECK(a.max_mean_curvature_before == b.max_mean_curvature_before);
    CHECK(a.max_mean_curvature_after == b.max_mean_curvature_after);
    check_same(a.displacement.tangential, b.displacement.tangential);
    check_same(a.displacement.normal, b.displacement.normal);
    REQUIRE(a.gap.has_value() == b.gap.has_value());
    if (a.gap)
        check_same(*a.gap, *b.gap);
    CHECK(a.iterations == b.iterations);
    CHECK(a.residual == b.residual);
    CHECK(a.estimated_v_max == b.estimated_v_max);
    REQUIRE(a.distance.has_value() == b.distance.has_value());
    if (a.distance)
        CHECK(a.distance->max == b.distance->max);
}

/// Going on after each step gives the same bits and the same report.
void check_resumed(const PolygonMesh& mesh, const FlowOptions& options)
{
    const Outcome whole = run(mesh, options);
    for (int step = 1; step <= options.steps; ++step) {
        CAPTURE(step);
        FlowOptions other_threads = options;
        other_threads.resources.threads = 3;
        const auto state = state_after(step, mesh, other_threads);
        CHECK(state->n_steps() == step);
        const Outcome resumed = run(mesh, options, state);
        CHECK(test::same_bits(resumed.positions, whole.positions));
        REQUIRE(resumed.report.steps.size() == whole.report.steps.size());
        for (std::size_t i = 0; i < whole.report.steps.size(); ++i)
            check_same(resumed.report.steps[i], whole.report.steps[i]);
        check_same(resumed.report.displacement->path.tangential, whole.report.displacement->path.tangential);
        check_same(resumed.report.displacement->drift, whole.report.displacement->drift);
        CHECK(resumed.report.choices == whole.report.choices);
        CHECK(resumed.report.remarks == whole.report.remarks);
        CHECK(resumed.report.convergence.steps_short_of_tolerance == whole.report.convergence.steps_short_of_tolerance);
        CHECK(resumed.report.seconds.step >= state->seconds.step);
        CHECK(resumed.report.seconds.factorise >= state->seconds.factorise);
        REQUIRE(resumed.report.separated.has_value() == options.report.keep_gaps);
        if (options.report.keep_gaps)
            CHECK(test::same_bits(resumed.report.separated->vertices, whole.report.separated->vertices));
    }
}

}  // namespace

TEST_CASE("a flow that goes on after any step ends with the same bits and the same report")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(600), make_noisy_sphere(500)})
        for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
            CAPTURE(kind.name);
            check_resumed(mesh, kind.options);
        }
}

TEST_CASE("sweeps that begin with rescaled surfaces go on with the same bits, with copies of the interface, too")
{
    PolygonMesh mesh = make_noisy_sphere(500);
    mesh.vertices.rowwise() += Point(0.1, 2.0, -0.7);
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Robin, Conditions::Schwarz}) {
        FlowOptions options;
        options.time_step = 0.02;
        options.steps = 4;
        options.cut.subdomains = 3;
        options.flow = FlowEquation::Conformalized;
        options.motion.rescale = Rescale::Volume;
        options.accuracy.approach = Approach::Sweep;
        options.interface.conditions = conditions;
        options.report.reference = true;
        check_resumed(mesh, options);
    }
}

TEST_CASE("a state continues from a state")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    const FlowOptions options = test::flow_kinds(mean_edge_length(mesh)).front().options;
    auto state = state_after(1, mesh, options);
    for (int step = 2; step <= options.steps; ++step) {
        FlowOptions one_more = options;
        one_more.steps = step;
        PolygonMesh moved = mesh;
        mean_curvature_flow(moved, one_more,
                            [&](const StepState& now) { state = std::make_shared<const FlowState>(now.capture()); },
                            {.stop = {}, .on_progress = {}, .resume = state});
        CHECK(test::same_bits(state->positions(), moved.vertices));
    }
    CHECK(test::same_bits(state->positions(), test::flowed(mesh, options)));
}

TEST_CASE("a state of another flow is refused by what differs")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    const FlowOptions options = test::flow_kinds(mean_edge_length(mesh)).front().options;
    const auto state = state_after(2, mesh, options);
    const auto refused = [&](const PolygonMesh& other_mesh, auto change) {
        FlowOptions other = options;
        change(other);
        try {
            run(other_mesh, other, state);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto names = [](const std::string& message, const char* what) {
        return message.find(what) != std::string::npos;
    };
    const auto nothing = [](FlowOptions&) {};
    PolygonMesh moved = mesh;
    moved.vertices(7, 1) += 1e-13;
    CHECK(names(refused(moved, nothing), "the mesh was 600"));
    CHECK(names(refused(make_quads(400), nothing), "the mesh was 600"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.time_step *= 2; }), "time_step"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.laplacian = Laplacian::AlexaWardetzky; }),
                "laplacian was fujiwara then and is alexa-wardetzky now"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.cut.subdomains = 6; }), "subdomains was 7"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.accuracy.tolerance = 0.1; }), "tolerance was none"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.interface.sweep = Sweep::Fixed; }), "sweep"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.report.reference = true; }), "reference"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.motion.fixed_vertices = {5}; }), "fixed_vertices was none"));
    CHECK(names(refused(mesh, [](FlowOptions& o) { o.steps = 1; }), "already after step 2"));
    CHECK(refused(mesh, [](FlowOptions& o) {
              o.resources.threads = 2, o.steps = 9, o.report.record_schedule = true;
          }).empty());
    CHECK(refused(mesh, nothing).empty());

    FlowState broken = *state;
    broken.flow.arrays.pop_back();
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.numbers.front() = -1.0;
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.positions.conservativeResize(599, 3);
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.positions(300, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(run(mesh, options, std::make_shared<const FlowState>(broken)),
                         doctest::Contains("positions that are not finite"), InputError);
    broken = *state;
    broken.displacement.drift.resize(0, 3);
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
}

TEST_CASE("every option that changes results tells flows apart, by its own name")
{
    using Change = void (*)(FlowOptions&);
    const std::pair<const char*, Change> changes[] = {
        {"laplacian", [](FlowOptions& o) { o.laplacian = Laplacian::PtackovaVelho; }},
        {"flow", [](FlowOptions& o) { o.flow = FlowEquation::Conformalized; }},
        {"filter", [](FlowOptions& o) { o.filter = Filter::LowPass, o.order = 1; }},
        {"order", [](FlowOptions& o) { o.order = 3; }},
        {"uniform_edge", [](FlowOptions& o) { o.uniform_edge = 0.5; }},
        {"within", [](FlowOptions& o) { o.motion.within = 0.5; }},
        {"limit_of_volume", [](FlowOptions& o) { o.motion.limits.volume = 0.5; }},
        {"limit_of_slide", [](FlowOptions& o) { o.motion.limits.slide = 0.5; }},
        {"feature_edges",
         [](FlowOptions& o) {
             o.motion.feature_edges = {{0, 1}};
         }},
        {"limit_of_move", [](FlowOptions& o) { o.motion.limits.move = 0.5; }},
        {"attachment", [](FlowOptions& o) { o.motion.attachment = 2.0; }},
        {"attachment_weights", [](FlowOptions& o) { o.motion.attachment_weights = {2.0}; }},
        {"strength", [](FlowOptions& o) { o.motion.strength = {0.5}; }},
        {"direction", [](FlowOptions& o) { o.motion.direction.kind = MotionDirection::Kind::Normal; }},
        {"time_step", [](FlowOptions& o) { o.time_step = 0.5; }},
        {"subdomains", [](FlowOptions& o) { o.cut.subdomains = 3; }},
        {"labels",
         [](FlowOptions& o) {
             o.cut.labels = {0, 1};
         }},
        {"colouring", [](FlowOptions& o) { o.interface.colouring = Colouring::Label; }},
        {"conditions", [](FlowOptions& o) { o.interface.conditions = Conditions::Ventcell; }},
        {"scheme", [](FlowOptions& o) { o.scheme = Scheme::ExplicitEuler; }},
        {"keep_edges", [](FlowOptions& o) { o.keep_edges = 30.0; }},
        {"denoise", [](FlowOptions& o) { o.denoise = true; }},
        {"transmission", [](FlowOptions& o) { o.interface.transmission = Transmission::Derivative; }},
        {"p", [](FlowOptions& o) { o.interface.p = 2.0; }},
        {"p_rule", [](FlowOptions& o) { o.interface.p_rule = PRule::InverseStep; }},
        {"p_edge", [](FlowOptions& o) { o.interface.p_edge = PEdge::Mean; }},
        {"q", [](FlowOptions& o) { o.interface.q = 0.5; }},
        {"overlap", [](FlowOptions& o) { o.interface.overlap = 2; }},
        {"sweep", [](FlowOptions& o) { o.interface.sweep = Sweep::Fixed; }},
        {"weld", [](FlowOptions& o) { o.motion.weld.reset(); }},
        {"boundary", [](FlowOptions& o) { o.motion.boundary = Boundary::Free; }},
        {"junctions", [](FlowOptions& o) { o.motion.junctions = Junctions::Hold; }},
        {"fixed_vertices", [](FlowOptions& o) { o.motion.fixed_vertices = {1}; }},
        {"rescale", [](FlowOptions& o) { o.motion.rescale = Rescale::Area; }},
        {"correction", [](FlowOptions& o) { o.interface.correction = Correction::None; }},
        {"tolerance", [](FlowOptions& o) { o.accuracy.tolerance = 0.1; }},
        {"approach", [](FlowOptions& o) { o.accuracy.approach = Approach::Sweep; }},
        {"converge_iterations", [](FlowOptions& o) { o.accuracy.converge_iterations = 7; }},
        {"reference", [](FlowOptions& o) { o.report.reference = true; }},
        {"factorisation", [](FlowOptions& o) { o.resources.factorisation = Factorisation::Own; }},
        {"measures", [](FlowOptions& o) { o.report.measures = false; }},
        {"tune_for", [](FlowOptions& o) { o.resources.tune_for = 16; }},
        {"precision", [](FlowOptions& o) { o.resources.precision = Precision::Double; }},
    };
    const PolygonMesh mesh = make_quads(100);
    const auto base = identify(mesh, {}).entries;
    CHECK(base.size() == std::size(changes) + 2);  // and the version and the mesh
    for (const auto& change : changes) {
        const std::string name = change.first;
        CAPTURE(name);
        FlowOptions options;
        change.second(options);
        const auto changed = identify(mesh, options).entries;
        for (std::size_t i = 0; i < base.size(); ++i)
            CHECK((changed[i].value != base[i].value) == (changed[i].name == name));
    }
}

TEST_CASE("positions of sub-meshes that are not finite are refused; an estimate that has overflowed goes on as such")
{
    const PolygonMesh mesh = make_triangles(600);
    const double infinity = std::numeric_limits<double>::infinity();
    const auto with_infinite_arrays = [&](const FlowOptions& options) {
        FlowState state = *state_after(1, mesh, options);
        REQUIRE(!state.flow.arrays.empty());
        for (Points& array : state.flow.arrays)
            array.setConstant(infinity);
        return std::make_shared<const FlowState>(std::move(state));
    };
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        if (kind.name == "fujiwara by Schwarz")
            CHECK_THROWS_AS(run(mesh, kind.options, with_infinite_arrays(kind.options)), InputError);
        if (kind.name != "fujiwara by sweeps")
            continue;
        const Outcome expected = run(mesh, kind.options);
        const Outcome resumed = run(mesh, kind.options, with_infinite_arrays(kind.options));
        CHECK(resumed.positions == expected.positions);
        CHECK(expected.report.steps.back().estimated_v_max.has_value());
        CHECK_FALSE(resumed.report.steps.back().estimated_v_max.has_value());
    }
}
