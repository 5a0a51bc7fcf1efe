// Which options of denoise() are valid.

#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/denoise/denoise_options.h"
#include "engine/options/motion_option_table.h"
#include "engine/options/motion_rules.h"
#include "engine/options/option_limits.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

using Asked = AskedOptions;

/// Whether the options have this method.
template <class Method>
bool is(const DenoiseOptions& options)
{
    return std::holds_alternative<Method>(options.method);
}

/// Whether steps of rounding are given.
bool has_steps(const DenoiseOptions& options)
{
    const auto* const method = std::get_if<RemoveNoise>(&options.method);
    return method != nullptr && method->rounding.kind == Rounding::Kind::Given;
}

/// Whether steps are given, but none in the direction of an axis along which vertices move.
bool has_no_step_along(const DenoiseOptions& options)
{
    const MotionDirection& direction = options.motion.direction;
    if (!has_steps(options) || direction.kind != MotionDirection::Kind::Vector || direction.is_oblique())
        return false;
    return std::get<RemoveNoise>(options.method).rounding.steps.cwiseProduct(direction.vector).isZero(0.0);
}

/// The rules on options that a method excludes.
constexpr OptionRule<DenoiseOptions> of_methods[]{
    {[](const DenoiseOptions& o, const Asked& asked) { return is<SmoothRims>(o) && asked.has("feature_edges"); }, 0,
     "<feature_edges> names edges to keep, but the boundary alone moves: leave them out"},
    {[](const DenoiseOptions& o, const Asked&) { return has_steps(o) && o.motion.direction.is_oblique(); }, 0,
     "<rounded> bounds x, y and z one by one, which vertices that move along <direction> cannot keep: give an axis, or "
     "leave one of them out"},
    {[](const DenoiseOptions& o, const Asked&) { return has_no_step_along(o); }, 0,
     "<rounded> is 0 along <direction>, so that nothing could move: give a step there, or leave one of them out"},
    {[](const DenoiseOptions&, const Asked& asked) {
         return asked.has("attachment") || asked.has("attachment_radius") || asked.has("attachment_weights");
     },
     0, "<attachment> is for flows, whose equations it is a term of: leave it out"},
};

/// The options of motion that differ from the defaults of denoise().
AskedOptions changed_options(const MotionOptions& motion)
{
    const auto first = [&motion](const std::function<bool(const OptionTraits&)>& matches) {
        static const MotionOptions defaults = DenoiseOptions::default_motion();
        std::string found;
        for_each_pair(motion_table(motion), motion_table(defaults), [&](const auto& row, const auto& by_default) {
            if (found.empty() && matches(row) && *row.value != *by_default.value)
                found = row.field;
        });
        return found;
    };
    return {[first](std::string_view option) {
                return !first([&](const OptionTraits& row) { return row.field == option; }).empty();
            },
            [first](unsigned concerns) {
                return first([&](const OptionTraits& row) { return (row.concerns & concerns) != 0; });
            }};
}

constexpr OptionTraits row_of_angle{.field = "keep_edges", .limits = limits_of_edge_angle};
constexpr OptionTraits row_of_radius{.field = "radius", .limits = limits_of_radius};
constexpr OptionTraits row_of_time_step{.field = "time_step", .limits = limits_of_time_step};
constexpr OptionTraits row_of_edges{.field = "time_step_edges", .limits = limits_of_time_step_edges};

void require_valid(const SmoothingAmount& amount)
{
    if ((amount.time_step != 0.0) + amount.time_step_edges.has_value() + amount.radius.has_value() > 1)
        refuse("<time_step>, <time_step_edges> and <radius> all say how much to smooth: give one of them");
    require_within(row_of_radius, amount.radius);
    require_within(row_of_edges, amount.time_step_edges);
    if (!amount.radius && !amount.time_step_edges)
        require_within(row_of_time_step, amount.time_step);
}

/// Checks the numbers of a method.
struct RequireValid {
    void operator()(const RemoveNoise& method) const
    {
        require_within(row_of_angle, method.edge_angle);
        const Point& steps = method.rounding.steps;
        if (method.rounding.kind == Rounding::Kind::Given &&
            !(steps.allFinite() && steps.minCoeff() >= 0.0 && !steps.isZero(0.0)))
            refuse("<rounded> are the steps of x, y and z: finite, at least 0, and not all 0");
    }
    void operator()(const SmoothBetweenEdges& method) const
    {
        require_within(row_of_angle, method.edge_angle);
        require_valid(method.amount);
    }
    void operator()(const SmoothRims& method) const { require_valid(method.amount); }
};

}  // namespace

void require_valid(const DenoiseOptions& options)
{
    std::visit(RequireValid(), options.method);
    require_within({.field = "steps", .limits = limits_of_steps}, options.steps);
    require_within({.field = "threads", .limits = limits_of_threads}, options.threads);
    for_each_row(motion_table(options.motion), [](const auto& row) {
        if constexpr (requires { require_within(row, *row.value); })
            if (!row.limits.text.empty())
                require_within(row, *row.value);
    });
    require_valid_vertex_values(options.motion);
    const AskedOptions asked = changed_options(options.motion);
    require_compatible(options.motion, asked);
    require_none_broken<DenoiseOptions>(of_methods, options, asked, fill_other);
}

}  // namespace seamflow
