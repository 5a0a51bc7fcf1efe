#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include <doctest/doctest.h>

#include "engine/options/option_table.h"
#include "engine/options/valid_options.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

using O = FlowOptions;

FlowOptions plain_steps()
{
    return {.time_step = 1e-3};
}

/// Empty: the options are taken.
std::string refusal_of(const FlowOptions& options)
{
    return test::message_of([&] { require_valid(options); });
}

void put(MotionBound& to, double value)
{
    to = {1.0, 1.0, value};
}

void put(LengthOnMesh& to, double value)
{
    to.value = value;
}

template <class Number>
requires std::is_arithmetic_v<Number>
void put(Number& to, double value)
{
    to = static_cast<Number>(value);
}

template <class Number>
void put(std::optional<Number>& to, double value)
{
    put(to.emplace(), value);
}

template <class Number>
constexpr bool is_whole = std::is_integral_v<Number>;
template <class Number>
constexpr bool is_whole<std::optional<Number>> = std::is_integral_v<Number>;

struct Refusal {
    /// What the message begins with.
    std::string_view message;
    void (*change)(FlowOptions&);
};

constexpr auto make_linear = [](O& o) { o.flow = FlowEquation::Linear; };
constexpr auto make_conformalized = [](O& o) { o.flow = FlowEquation::Conformalized; };
constexpr auto make_low_pass = [](O& o) { o.filter = Filter::LowPass; };
constexpr auto make_robin = [](O& o) { o.interface.conditions = Conditions::Robin; };
constexpr auto make_schwarz = [](O& o) { o.interface.conditions = Conditions::Schwarz; };
constexpr auto make_gradients = [](O& o) { o.accuracy.approach = Approach::ConjugateGradients; };
constexpr auto make_region = [](O& o) { o.motion.strength.assign(121, 1.0); };

constexpr Refusal refusals[]{
    {"steps is -1, but must be at least 0", [](O& o) { o.steps = -1; }},
    {"subdomains is -1", [](O& o) { o.cut.subdomains = -1; }},
    {"overlap is 0", [](O& o) { o.interface.overlap = 0; }},
    {"attachment is -1, but must be at least 0 and finite (1/length²)", [](O& o) { o.motion.attachment = -1.0; }},
    {"weld is -1", [](O& o) { o.motion.weld = -1.0; }},
    {"time_step, time_step_edges and radius all say", [](O& o) { o.radius = LengthOnMesh{1.0}; }},
    {"the label of face 2 is -3",
     [](O& o) {
         o.cut.labels = {0, 1, -3};
     }},
    {"the attachment weight of vertex 1 is -2",
     [](O& o) {
         o.motion.attachment_weights = {1.0, -2.0};
     }},
    {"time_step, time_step_edges and radius all say", [](O& o) { o.time_step_edges = 1.0; }},
    {"feather is for the rim of a region: give strength as well", [](O& o) { o.motion.feather = 1.0; }},
    {"attachment and attachment_radius both say",
     [](O& o) { o.motion.attachment = 1.0, o.motion.attachment_radius = 1.0; }},
    {"attachment and attachment_weights both say how vertices are attached: leave one of them out",
     [](O& o) { o.motion.attachment_radius = 1.0, o.motion.attachment_weights = {1.0}; }},
    {"attachment and attachment_weights both say how vertices are attached: leave one of them out",
     [](O& o) { o.motion.attachment = 1.0, o.motion.attachment_weights = {1.0}; }},
    {"the strength of vertex 1 is 1.5, but must be from 0 to 1",
     [](O& o) {
         o.motion.strength = {1.0, 1.5};
     }},
    {"correction is centroid, but with the classical",
     [](O& o) { make_robin(o), o.interface.correction = Correction::Centroid; }},
    {"q is given, but belongs only", [](O& o) { make_robin(o), o.interface.q = 0.1; }},
    {"conditions ventcell needs q, the Ventcell parameter",
     [](O& o) { o.interface.conditions = Conditions::Ventcell; }},
    {"keep_gaps is for the classical", [](O& o) { o.report.keep_gaps = true; }},
    {"keep_gaps is for backward Euler",
     [](O& o) { make_robin(o), o.report.keep_gaps = true, o.scheme = Scheme::ExplicitEuler; }},
    {"sweep is alternating", [](O& o) { make_schwarz(o), o.interface.sweep = Sweep::Alternating; }},
    {"p is given", [](O& o) { make_schwarz(o), o.interface.p = 20.0; }},
    {"tolerance is given, which rules out", [](O& o) { make_schwarz(o), o.accuracy.tolerance = 1e-3; }},
    {"approach is cg, which rules out conditions", [](O& o) { make_gradients(o), make_robin(o); }},
    {"approach is cg, which rules out scheme", [](O& o) { make_gradients(o), o.scheme = Scheme::ExplicitEuler; }},
    {"approach is cg, which takes the whole mesh", [](O& o) { make_gradients(o), o.cut.subdomains = 2; }},
    {"approach is cg, which takes the whole mesh",
     [](O& o) {
         make_gradients(o), o.cut.labels = {0, 0};
     }},
    {"approach is by conjugate gradients, but the Laplacian ptackova-velho",
     [](O& o) { make_gradients(o), o.laplacian = Laplacian::PtackovaVelho; }},
    {"approach is cg, but conjugate gradients factorise nothing: leave factorisation out",
     [](O& o) { make_gradients(o), o.resources.factorisation = Factorisation::Own; }},
    {"vertices are attached, but the Laplacian",
     [](O& o) { o.motion.attachment = 1.0, o.laplacian = Laplacian::PtackovaVelho; }},
    {"filter is low-pass, of order 2, but the Laplacian",
     [](O& o) { make_low_pass(o), o.laplacian = Laplacian::PtackovaVelho; }},
    {"filter is low-pass, of order 2, which sweeps support", [](O& o) { make_low_pass(o), o.interface.p = 1.0; }},
    {"flow is conformalized, but the Laplacian ptackova-velho is not symmetric: use fujiwara, alexa-wardetzky, "
     "virtual-refinement or uniform",
     [](O& o) { make_conformalized(o), o.laplacian = Laplacian::PtackovaVelho; }},
    {"flow is conformalized, which is for backward Euler",
     [](O& o) { make_conformalized(o), o.scheme = Scheme::ExplicitEuler; }},
    {"flow is conformalized, but approach is by conjugate gradients",
     [](O& o) { make_conformalized(o), make_gradients(o); }},
    {"approach sweep is about sweeps, but flow linear takes none: leave one of them out",
     [](O& o) { make_linear(o), o.accuracy.approach = Approach::Sweep; }},
    {"conditions is about sweeps, but flow linear takes none", [](O& o) { make_linear(o), make_robin(o); }},
    {"strength is given, whose steps are converged or undecomposed, but approach sweep is for sweeps: leave one",
     [](O& o) { make_region(o), o.accuracy.approach = Approach::Sweep; }},
    {"rescale moves every vertex, but those with a strength of 0 are to stay",
     [](O& o) { make_region(o), o.motion.rescale = Rescale::Area; }},
    {"rescale moves every vertex, but fixed_vertices holds some: leave rescale out; filter low-pass",
     [](O& o) { o.motion.rescale = Rescale::Volume, o.motion.fixed_vertices = {3}; }},
    {"direction must be a finite vector other than 0",
     [](O& o) { o.motion.direction.kind = MotionDirection::Kind::Vector; }},
    {"direction lets vertices move along lines alone",
     [](O& o) { o.motion.direction.kind = MotionDirection::Kind::Normal, o.motion.rescale = Rescale::Volume; }},
    {"feature_edges names edges to keep, which flows do not",
     [](O& o) {
         o.motion.feature_edges = {{0, 1}};
     }},
    {"rescale and within move vertices off feature_edges",
     [](O& o) {
         o.motion.feature_edges = {{0, 1}}, o.motion.within = 1.0;
     }},
    {"rescale and within move vertices off feature_edges",
     [](O& o) {
         o.motion.feature_edges = {{0, 1}}, o.motion.rescale = Rescale::Area;
     }},
};

}  // namespace

TEST_CASE("every number is refused outside its limits by the name of its option, and taken within")
{
    FlowOptions options = plain_steps();
    REQUIRE(refusal_of(options).empty());
    int n_numbers = 0;
    for_each_option(options, [&](const auto& row) {
        if constexpr (requires { put(*row.value, 0.0); }) {
            const Limits& limits = row.limits;
            if (limits.text.empty())
                return;
            ++n_numbers;
            const auto before = *row.value;
            const auto is_refused = [&](double value) {
                put(*row.value, value);
                if (row.field == "radius" || row.field == "time_step_edges")
                    options.time_step = 0.0;
                const std::string refusal = refusal_of(options);
                options.time_step = 1e-3;
                *row.value = before;
                return refusal.starts_with(std::string(row.field) + " is ") && refusal.ends_with(limits.text);
            };
            CAPTURE(row.field);
            constexpr bool is_real = !is_whole<std::decay_t<decltype(before)>>;
            CHECK(is_refused(limits.least - 1.0));
            CHECK(is_refused(limits.least) == limits.above_least);
            CHECK_FALSE(is_refused(std::nextafter(limits.least, 1.0) + (is_real ? 0.0 : 1.0)));
            if (std::isfinite(limits.most))
                CHECK(is_refused(limits.most + 1.0));
            if (is_real)
                CHECK(is_refused(std::nan("")));
        }
    });
    CHECK(n_numbers > 15);
}

TEST_CASE("options that exclude each other are refused with what to do")
{
    for (const Refusal& refusal : refusals) {
        FlowOptions options = plain_steps();
        refusal.change(options);
        CHECK_MESSAGE(refusal_of(options).starts_with(refusal.message),
                      refusal.message << " expected, but found: " << refusal_of(options));
    }
    for (void (*const change)(FlowOptions&) : std::initializer_list<void (*)(FlowOptions&)>{
             make_linear, make_conformalized, make_low_pass, make_robin, make_schwarz, make_gradients, make_region}) {
        FlowOptions options = plain_steps();
        change(options);
        CHECK(refusal_of(options).empty());
    }
}
