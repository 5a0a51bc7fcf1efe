#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/options/option_table.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/support/option_cases.h"
#include "tests/support/outcome.h"
#include "tests/support/writings.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double anything = std::numeric_limits<double>::infinity();

/// Where a result may differ, and why.
struct Allowance {
    /// Of simple_changes; empty: any.
    std::string_view change;
    std::string_view other_change;
    /// One of names_of; empty: any.
    std::string_view option;
    /// In mean edge lengths.
    double tolerance;
    std::string_view reason;

    [[nodiscard]] bool is_for(const Change& c, const std::vector<std::string>& options) const
    {
        const auto has = [&](std::string_view name) { return name.empty() || c.has(name); };
        return has(change) && has(other_change) && (option.empty() || std::ranges::count(options, option) > 0);
    }
};

constexpr Allowance differences[]{
    {"turned", "", "a part of the diagonal", anything, "the box is along the axes"},
    {"second body", "", "a part of the diagonal", anything, "the box is that of both"},
    {"second body", "", "time_step_edges", anything, "the mean edge length is that of all faces"},
    {"sliver at the boundary", "", "time_step_edges", 0.1, "the same"},
    {"hole closed", "", "time_step_edges", 0.1, "the same"},
    {"sliver at the boundary", "", "feather", 0.1, "distances cross it"},
    {"second body", "", "laplacian uniform", anything, "its unit is the mean edge length of all faces"},
    {"sliver at the boundary", "", "laplacian uniform", 0.1, "the same"},
    {"hole closed", "", "laplacian uniform", 0.1, "the same"},
    {"sliver at the boundary", "", "laplacian ptackova-velho", anything, "rows reach two rings"},
    {"hole closed", "", "laplacian ptackova-velho", anything, "the same"},
    {"hole closed", "", "sweeps", anything, "the interface crosses the hole"},
    {"in thousandths", "", "p of the paper", anything, "p* has a unit"},
    {"times a power of two", "", "p of the paper", anything, "the same"},
    {"sliver at the boundary", "", "p of edges", anything, "p* depends on the edges of a sub-mesh"},
    {"sliver at the boundary", "", "free boundary", anything, "its vertex moves"},
    {"hole closed", "", "free boundary", anything, "the rim moves"},
    {"sliver at the boundary", "", "boundary smooth", anything, "its vertex is one more of the rim"},
    {"hole closed", "", "boundary smooth", anything, "the rim moves"},
    {"sliver inside", "", "", anything, "its vertices are held, and named"},
    {"sliver at the boundary", "", "edges kept", 0.1, "it counts for the noise"},
    {"second body", "", "rescale volume", anything, "an open body has no volume"},
    {"sliver at the boundary", "", "limit_of_move", 0.01, "the mean is over all vertices"},
    {"second body", "", "edges kept", anything, "the noise is that of both"},
    {"hole closed", "", "edges kept", anything, "its normal counts"},
    {"faces twice", "", "keep_gaps", anything, "sub-meshes have all faces"},
    {"faces twice", "", "strict", anything, "such a mesh is not manifold"},
    {"sliver at the boundary", "", "strict", anything, "it has no area"},
    {"hole closed", "", "rescale", anything, "all vertices move, those of the rim, too"},
    {"some faces turned round", "", "rescale volume", anything, "there is no volume"},
    {"some faces turned round", "", "limit_of_volume", anything, "the same"},
    {"some faces turned round", "seams", "", anything, "only edges that run in opposite directions are joined"},
    {"some faces turned round", "seams, copies first", "", anything, "the same"},
    {"turned", "", "rounded", anything, "steps are along the axes"},
    {"turned", "", "within along axes", anything, "the same"},
    {"sliver at the boundary", "", "rounded", anything, "it is one neighbour more"},
    {"hole closed", "", "rounded", anything, "the same"},
    {"some faces turned round", "", "rounded", anything, "there is no volume"},
    {"", "", "rounded", 1e-4, "rounding grows in many iterations, and may make one more"},
    {"", "", "precision single", 1e-5, "rounding"},
    {"", "", "loose", 1e-2, "steps converge no further"},
    {"", "", "denoise", 0.3, "what rounding changes may change the choice of a filter, or of the facet of a face"},
};

/// What is measured of steps: the largest of all vertices, which copies do not change, in mean edge lengths.
std::map<std::string, double> measures_of(const SmoothReport& report, double edge)
{
    std::map<std::string, double> of;
    for (std::size_t i = 0; i < report.steps.size(); ++i) {
        const StepReport& step = report.steps[i];
        const auto add = [&](const char* what, double value) { of[what + std::to_string(i + 1)] = value; };
        add("curvature after step ", step.max_mean_curvature_after * edge);
        add("tangential displacement in step ", step.displacement.tangential.max / edge);
        add("normal displacement in step ", step.displacement.normal.max / edge);
        add("estimated distance after step ", step.estimated_v_max.value_or(0.0));
        add("gap after step ", step.gap ? step.gap->max / edge : 0.0);
        add("distance after step ", step.distance ? step.distance->max / edge : 0.0);
        add("distance of surfaces after step ", step.surface_distance ? step.surface_distance->max / edge : 0.0);
    }
    if (report.displacement)
        of["drift"] = report.displacement->drift.max / edge;
    return of;
}

/// A flow of a mesh with some options.
struct Original {
    const PolygonMesh& mesh;
    std::vector<OptionCase> cases;
    double edge;
    AllOptions options;
    Outcome outcome;

    Original(const PolygonMesh& of, const std::vector<OptionCase>& with)
        : mesh(of)
        , cases(with)
        , edge(mean_edge_length(of))
        , options(options_without_cases(edge))
    {
        for (const OptionCase& c : cases)
            c.set(options, mesh, edge);
        outcome = outcome_of(mesh, options);
    }
};

/// Fields alone, fields with values, and what follows from several.
std::vector<std::string> names_of(const Original& original)
{
    std::vector<std::string> names;
    for (const OptionCase& c : original.cases) {
        names.emplace_back(c.field);
        names.push_back(c.name());
    }
    const AllOptions& o = original.options;
    const InterfaceOptions& on_interface = o.interface;
    const auto add_if = [&](bool condition, const char* name) {
        if (condition)
            names.emplace_back(name);
    };
    const bool has_parameter = !on_interface.p && (on_interface.conditions == Conditions::AdaptedVentcell ||
                                                   is_classical(on_interface.conditions) || !predicts(o));
    const auto is_part = [](const OptionCase& c) { return c.value == "%"; };
    add_if(std::ranges::any_of(original.cases, is_part), "a part of the diagonal");
    add_if(o.accuracy.approach == Approach::Sweep, "sweeps");
    add_if(has_parameter, "p of edges");
    add_if(has_parameter && on_interface.p_rule == PRule::Paper, "p of the paper");
    add_if(o.motion.boundary == Boundary::Free, "free boundary");
    add_if(o.keep_edges.has_value(), "edges kept");
    add_if(o.accuracy.approach == Approach::Converged && !o.accuracy.tolerance, "loose");
    return names;
}

/// The largest difference that is right.
double tolerance_of(const Change& change, const std::vector<std::string>& options)
{
    double tolerance = change.tolerance();
    for (const Allowance& allowance : differences)
        if (allowance.is_for(change, options))
            tolerance = std::max(tolerance, allowance.tolerance);
    return tolerance;
}

/// What is wrong with the same flow of the surface as it is written otherwise; empty: nothing.
std::string complaint(const Original& original, const Change& change)
{
    const double tolerance = tolerance_of(change, names_of(original));
    if (tolerance == anything)
        return {};
    const Writing w = change(original.mesh);
    const Outcome here = outcome_of(w.mesh, w.options(original.options));
    if (here.refusal != original.outcome.refusal)
        return here.refusal + " " + here.message + " in place of " + original.outcome.refusal + " " +
               original.outcome.message;
    if (!here.refusal.empty())
        return {};
    const double difference = w.difference(w.read_back(here.end), original.outcome.end) / original.edge;
    if (!(difference <= tolerance))
        return "vertices are " + std::to_string(difference) + " mean edges off";
    if (w.has_other_faces)
        return {};
    const auto measures = measures_of(here.report, w.scale * original.edge);
    for (const auto& [what, expected] : measures_of(original.outcome.report, original.edge))
        if (!(std::abs(measures.at(what) - expected) <= tolerance * (1.0 + std::abs(expected))))
            return what + " is " + std::to_string(measures.at(what)) + ", not " + std::to_string(expected);
    return {};
}

/// Whether the second change finds the surface as it was, and rounds it no more than alone.
bool are_independent(const SimpleChange& a, const SimpleChange& b)
{
    const auto needs_first = [](const SimpleChange& c) {
        return c.name.starts_with("sliver") || c.name == "hole closed";
    };
    const auto rounds = [](const SimpleChange& c) { return c.name == "far away" || c.name == "floats"; };
    const auto scales = [](const SimpleChange& c) { return c.name == "times a power of two"; };
    return a.name != b.name && !needs_first(b) && !(rounds(a) && (rounds(b) || scales(b))) && !(scales(a) && rounds(b));
}

std::vector<std::string> fields_that_differ(const AllOptions& options, const AllOptions& from)
{
    std::vector<std::string> fields;
    for_each_pair(all_option_table(options), all_option_table(from), [&](const auto& a, const auto& b) {
        if (*a.value != *b.value)
            fields.emplace_back(a.field);
    });
    return fields;
}

}  // namespace

TEST_CASE("every option has a case that sets it")
{
    for (const OptionTraits& row : all_options())
        CHECK_MESSAGE(std::ranges::find(option_cases(), row.field, &OptionCase::field) != option_cases().end(),
                      row.field << " has no case in tests/support/option_cases.cpp");
    const PolygonMesh mesh = creased_sheet();
    for (const OptionCase& option : option_cases()) {
        const AllOptions without = options_without_cases(1.0);
        AllOptions options = without;
        option.set(options, mesh, 1.0);
        CHECK_MESSAGE(std::ranges::count(fields_that_differ(options, without), option.field) == 1, option.name());
    }
}

TEST_CASE("whatever the option, however the surface is written, the result is the same")
{
    for (const PolygonMesh& mesh : {creased_sheet(), rimmed_ball()}) {
        int n_flows = 0;
        for (const OptionCase& option : option_cases()) {
            const Original original(mesh, {option});
            n_flows += original.outcome.refusal.empty() ? 1 : 0;
            for (const SimpleChange& change : simple_changes()) {
                const std::string wrong = complaint(original, {{change}});
                CHECK_MESSAGE(wrong.empty(), option.name() << ", " << change.name << ": " << wrong);
            }
        }
        // An open surface has no volume.
        CHECK(n_flows >= std::ssize(option_cases()) - 1);
    }
}

TEST_CASE("however the surface is written, reported distances are those of the positions that an observer sees")
{
    for (const PolygonMesh& original : {creased_sheet(), rimmed_ball()})
        for (const SimpleChange& change : simple_changes()) {
            CAPTURE(change.name);
            const double edge = mean_edge_length(original);
            AllOptions options = options_without_cases(edge);
            option_case("reference yes").set(options, original, edge);
            const Writing w = Change{{change}}(original);
            PolygonMesh mesh = w.mesh;
            const PolygonMesh given = w.mesh;
            smooth_surface(mesh, w.options(options), [&](const StepState& state) {
                const VertexDistance seen = vertex_distance(given, *state.reference_positions, state.positions);
                CHECK(std::abs(state.report.distance->max - seen.max) <= 1e-6 * seen.max);
            });
        }
}

TEST_CASE("whatever the pair of changes, the result is the same")
{
    for (const PolygonMesh& mesh : {creased_sheet(), rimmed_ball()})
        for (const std::string_view name :
             {"steps 3", "flow linear", "approach sweep", "keep_edges 30", "attachment_weights ramp"}) {
            const Original original(mesh, {option_case(name)});
            for (const SimpleChange& a : simple_changes())
                for (const SimpleChange& b : simple_changes()) {
                    if (!are_independent(a, b))
                        continue;
                    const Change change{{a, b}};
                    const std::string wrong = complaint(original, change);
                    CHECK_MESSAGE(wrong.empty(), name << "; " << change.name() << ": " << wrong);
                }
        }
}

TEST_CASE("whatever the pair of options, however the surface is written, the result is the same")
{
    const std::vector<Change> changes{changes_named({"seams, copies first", "unused vertex", "faces reordered",
                                                     "faces turned round", "times a power of two"}),
                                      changes_named({"faces twice", "vertices renumbered", "turned"})};
    for (const PolygonMesh& mesh : {creased_sheet(), rimmed_ball()}) {
        int n_flows = 0;
        for (auto a = option_cases().begin(); a != option_cases().end(); ++a)
            for (auto b = std::next(a); b != option_cases().end(); ++b) {
                if (a->field == b->field)
                    continue;
                const Original original(mesh, {*a, *b});
                n_flows += original.outcome.refusal.empty() ? 1 : 0;
                for (const Change& change : changes) {
                    const std::string wrong = complaint(original, change);
                    CHECK_MESSAGE(wrong.empty(), a->name()
                                                     << ", " << b->name() << "; " << change.name() << ": " << wrong);
                }
            }
        CHECK(n_flows > 800);
    }
}
