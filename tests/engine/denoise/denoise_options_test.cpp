// Which options of denoise() are valid.

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "partition/errors.h"
#include "tests/support/messages.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

using O = DenoiseOptions;

/// Empty: nothing is wrong.
std::string refusal_of(const O& options)
{
    try {
        require_valid(options);
    } catch (const OptionError& error) {
        return error.what();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("each option of denoise is refused outside its limits, by its name")
{
    using Refusal = std::pair<std::string, std::function<void(O&)>>;
    const auto between = [](double angle, SmoothingAmount amount) {
        return [=](O& o) { o.method = SmoothBetweenEdges{angle, amount}; };
    };
    std::vector<Refusal> refusals{
        {"steps is -1, but must be at least 0", [](O& o) { o.steps = -1; }},
        {"steps is 1000000001", [](O& o) { o.steps = most_steps + 1; }},
        {"threads is 1025, but must be at least 0 and at most 1024", [](O& o) { o.threads = 1025; }},
        {"radius is 0, but must be positive", between(30.0, {.radius = LengthOnMesh{0.0, true}})},
        {"time_step, time_step_edges and radius all say how much",
         between(30.0, {.time_step = 1.0, .radius = LengthOnMesh{1.0}})},
        {"within is 0, but must be above 0", [](O& o) { o.motion.within = 0.0; }},
        {"weld is -1", [](O& o) { o.motion.weld = -1.0; }},
        {"the strength of vertex 1 is 2, but must be from 0 to 1",
         [](O& o) {
             o.motion.strength = {0.0, 2.0};
         }},
        {"direction must be a finite vector other than 0",
         [](O& o) { o.motion.direction.kind = MotionDirection::Kind::Vector; }},
        {"direction lets vertices move along lines alone",
         [](O& o) { o.motion.direction.kind = MotionDirection::Kind::Normal, o.motion.rescale = Rescale::Area; }},
        {"rescale moves every vertex, but fixed_vertices holds some",
         [](O& o) { o.motion.rescale = Rescale::Area, o.motion.fixed_vertices = {1}; }},
        {"rescale and within move vertices off feature_edges",
         [](O& o) {
             o.motion.within = 1.0, o.motion.feature_edges = {{0, 1}};
         }},
        {"feature_edges names edges to keep, but the boundary alone moves",
         [](O& o) {
             o.method = SmoothRims{{.time_step = 1.0}}, o.motion.feature_edges = {{0, 1}};
         }},
        {"rounded is 0 along direction",
         [](O& o) {
             o.method = RemoveNoise{.rounding = {Rounding::Kind::Given, Point(1.0, 1.0, 0.0)}};
             o.motion.direction = {MotionDirection::Kind::Vector, Point(0.0, 0.0, 1.0)};
         }},
        {"attachment is for flows", [](O& o) { o.motion.attachment = 1.0; }},
        {"attachment is for flows", [](O& o) { o.motion.attachment_weights = {1.0}; }},
    };
    for (const double angle : {0.0, 180.0, -1.0, not_a_number}) {
        refusals.emplace_back("keep_edges is ", [=](O& o) { o.method = RemoveNoise{angle}; });
        refusals.emplace_back("keep_edges is ", between(angle, {.time_step = 1.0}));
    }
    for (const Point& steps :
         {Point(0.0, 0.0, 0.0), Point(1.0, -1.0, 1.0), Point(infinite, 1.0, 1.0), Point(1.0, not_a_number, 1.0)})
        refusals.emplace_back("rounded are the steps", [=](O& o) {
            o.method = RemoveNoise{.rounding = {Rounding::Kind::Given, steps}};
        });
    for (const double time_step : {0.0, -1.0, infinite, not_a_number}) {
        refusals.emplace_back("time_step is ", between(30.0, {.time_step = time_step}));
        refusals.emplace_back("time_step is ", [=](O& o) { o.method = SmoothRims{{.time_step = time_step}}; });
    }
    for (const Refusal& refusal : refusals) {
        const std::string& message = refusal.first;
        O options;
        refusal.second(options);
        CHECK_MESSAGE(refusal_of(options).starts_with(message), message << " expected, but: " << refusal_of(options));
        PolygonMesh mesh = test::quad_grid(3, 3);
        const Points before = mesh.vertices;
        CHECK_THROWS(denoise(mesh, options));
        CHECK(mesh.vertices == before);
    }
}

TEST_CASE("the methods of denoise are valid by default, or with an amount, and with edges to keep")
{
    for (const DenoiseMethod& method :
         {DenoiseMethod(RemoveNoise{}), DenoiseMethod(SmoothBetweenEdges{.amount = {.time_step = 1.0}}),
          DenoiseMethod(SmoothBetweenEdges{.amount = {.radius = LengthOnMesh{0.01, true}}}),
          DenoiseMethod(SmoothRims{{.time_step = 1.0}})}) {
        O options{.method = method};
        CHECK(refusal_of(options).empty());
        options.motion.feature_edges = {{0, 1}};
        CHECK(refusal_of(options).empty() == !std::holds_alternative<SmoothRims>(method));
    }
}

TEST_CASE("a radius means the time step with which bumps of it lose half their height")
{
    PolygonMesh by_radius = test::triangle_grid(20, 20);
    for (Index v = 0; v < by_radius.n_vertices(); v += 3)
        by_radius.vertices(v, 2) += 0.2;
    PolygonMesh by_step = by_radius;
    const DenoiseReport report =
        denoise(by_radius, {.method = SmoothBetweenEdges{.amount = {.radius = LengthOnMesh{0.1, true}}}, .steps = 2});
    denoise(by_step, {.method = SmoothBetweenEdges{.amount = {.time_step = report.time_step}}, .steps = 2});
    CHECK(by_radius.vertices == by_step.vertices);
    CHECK(report.steps.size() == 2);
}
