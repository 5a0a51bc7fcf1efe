// A run continues from a state only with the mesh and the options that made it: each of them counts, and each alone.

#include <cstdint>
#include <functional>
#include <set>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/options/option_table.h"
#include "engine/state/flow_identity.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

struct Change {
    std::string_view field;
    std::function<void(FlowOptions&)> make;
};

/// One for each option that enters a result.
std::vector<Change> all_changes()
{
    return {
        {"laplacian", [](FlowOptions& o) { o.laplacian = Laplacian::VirtualRefinement; }},
        {"flow", [](FlowOptions& o) { o.flow = FlowEquation::Conformalized; }},
        {"filter",
         [](FlowOptions& o) {
             o.filter = Filter::LowPass;
             o.order = 1;
         }},
        {"order", [](FlowOptions& o) { o.order = 3; }},
        {"uniform_edge", [](FlowOptions& o) { o.uniform_edge = 0.25; }},
        {"weights", [](FlowOptions& o) { o.weights = Weights::AtLeastZero; }},
        {"time_step", [](FlowOptions& o) { o.time_step = 1e-3 * (1.0 + 1e-15); }},
        {"subdomains", [](FlowOptions& o) { o.cut.subdomains = 7; }},
        {"labels", [](FlowOptions& o) { o.cut.labels.back() += 1; }},
        {"colouring", [](FlowOptions& o) { o.interface.colouring = Colouring::Label; }},
        {"conditions", [](FlowOptions& o) { o.interface.conditions = Conditions::Robin; }},
        {"scheme", [](FlowOptions& o) { o.scheme = Scheme::ExplicitEuler; }},
        {"keep_edges", [](FlowOptions& o) { o.keep_edges = 30.0; }},
        {"transmission", [](FlowOptions& o) { o.interface.transmission = Transmission::Derivative; }},
        {"p", [](FlowOptions& o) { o.interface.p = 3.0; }},
        {"p_rule", [](FlowOptions& o) { o.interface.p_rule = PRule::InverseStep; }},
        {"p_edge", [](FlowOptions& o) { o.interface.p_edge = PEdge::Mean; }},
        {"q", [](FlowOptions& o) { o.interface.q = 0.5; }},
        {"overlap", [](FlowOptions& o) { o.interface.overlap = 2; }},
        {"sweep", [](FlowOptions& o) { o.interface.sweep = Sweep::Fixed; }},
        {"weld", [](FlowOptions& o) { o.motion.weld = 1e-9; }},
        {"boundary", [](FlowOptions& o) { o.motion.boundary = Boundary::Free; }},
        {"junctions", [](FlowOptions& o) { o.motion.junctions = Junctions::Hold; }},
        {"fixed_vertices", [](FlowOptions& o) { o.motion.fixed_vertices.push_back(5); }},
        {"feature_edges",
         [](FlowOptions& o) {
             o.motion.feature_edges = {{0, 1}};
         }},
        {"attachment", [](FlowOptions& o) { o.motion.attachment = 4.0; }},
        {"attachment_weights", [](FlowOptions& o) { o.motion.attachment_weights.back() = 2.0; }},
        {"strength", [](FlowOptions& o) { o.motion.strength.back() = 0.5; }},
        {"direction",
         [](FlowOptions& o) {
             o.motion.direction = {MotionDirection::Kind::Vector, Point(0.0, 0.0, 1.0)};
         }},
        {"denoise", [](FlowOptions& o) { o.denoise = true; }},
        {"rescale", [](FlowOptions& o) { o.motion.rescale = Rescale::Area; }},
        {"within", [](FlowOptions& o) { o.motion.within = 0.5; }},
        {"limit_of_volume", [](FlowOptions& o) { o.motion.limits.volume = 0.1; }},
        {"limit_of_move", [](FlowOptions& o) { o.motion.limits.move = 0.1; }},
        {"limit_of_slide", [](FlowOptions& o) { o.motion.limits.slide = 0.1; }},
        {"correction", [](FlowOptions& o) { o.interface.correction = Correction::None; }},
        {"tolerance", [](FlowOptions& o) { o.accuracy.tolerance = 1e-3; }},
        {"approach", [](FlowOptions& o) { o.accuracy.approach = Approach::Converged; }},
        {"converge_iterations", [](FlowOptions& o) { o.accuracy.converge_iterations = 9; }},
        {"reference", [](FlowOptions& o) { o.report.reference = true; }},
        {"factorisation", [](FlowOptions& o) { o.resources.factorisation = Factorisation::Cholmod; }},
        {"measures", [](FlowOptions& o) { o.report.measures = !o.report.measures; }},
        {"tune_for", [](FlowOptions& o) { o.resources.tune_for = 16; }},
        {"precision", [](FlowOptions& o) { o.resources.precision = Precision::Double; }},
    };
}

}  // namespace

TEST_CASE("a flow that differs in any one option, coordinate or corner has another identity")
{
    const PolygonMesh mesh = test::quad_grid(3, 3);
    FlowOptions options;
    options.time_step = 1e-3;
    options.cut.labels.assign(9, 0);
    options.motion.fixed_vertices = {3};
    options.motion.attachment_weights.assign(16, 1.0);
    options.motion.strength.assign(16, 1.0);
    options.motion.direction.kind = MotionDirection::Kind::Vector;
    std::set<std::uint64_t> identities{identify(mesh, options)};
    CHECK(identities.contains(identify(mesh, options)));
    std::set<std::string_view> tried;
    for (const Change& change : all_changes()) {
        CAPTURE(change.field);
        tried.insert(change.field);
        FlowOptions other = options;
        change.make(other);
        CHECK(identities.insert(identify(mesh, other)).second);
    }
    for (const OptionTraits& option : all_options()) {
        CAPTURE(option.field);
        CHECK(tried.contains(option.field) == ((option.concerns & concern::no_result) == 0));
    }
    for (const Eigen::Index i : {0, 7, 47}) {
        PolygonMesh other = mesh;
        other.vertices.data()[i] += 1e-15;
        CHECK(identities.insert(identify(other, options)).second);
    }
    PolygonMesh turned = mesh;
    std::swap(turned.face_vertices.front(), turned.face_vertices[2]);
    CHECK(identities.insert(identify(turned, options)).second);
}

TEST_CASE("an order that is left open is that of the filter")
{
    const PolygonMesh mesh = test::quad_grid(3, 3);
    FlowOptions options{.filter = Filter::LowPass, .time_step = 1e-3};
    const std::uint64_t identity = identify(mesh, options);
    options.order = 2;
    CHECK(identify(mesh, options) == identity);
    options.order = 3;
    CHECK(identify(mesh, options) != identity);
}

TEST_CASE("threads, memory and what is recorded do not make another flow")
{
    const PolygonMesh mesh = test::quad_grid(3, 3);
    FlowOptions options;
    options.time_step = 1e-3;
    const std::uint64_t identity = identify(mesh, options);
    options.steps += 5;
    options.resources.threads = 3;
    options.resources.memory_limit = 1'000'000;
    options.accuracy.largest_update = 2.0;
    options.report.record_schedule = true;
    CHECK(identify(mesh, options) == identity);
}
