#include "engine/fields/field_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "engine/measure/length_scale.h"
#include "engine/options/option_names.h"
#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// The time of the heat equation after which white noise is as smooth as after these steps, over the time of the steps.
double part_of_time(const FlowOptions& options)
{
    return options.steps > 1 && filter_of(options).is_plain() ? (options.steps - 1.0) / options.steps : 1.0;
}

}  // namespace

double time_for_fwhm(double fwhm, const FlowOptions& options)
{
    return fwhm * fwhm / (16.0 * std::numbers::ln2) / part_of_time(options);
}

double fwhm_for_time(double time, const FlowOptions& options)
{
    return std::sqrt(16.0 * std::numbers::ln2 * time * part_of_time(options));
}

namespace {

/// The options that the rules below are about.
struct FlowOfFields {
    const FlowOptions& flow;
    const FieldOptions& fields;
};

using FieldRule = OptionRule<FlowOfFields>;

bool moves_surface(const MotionOptions& motion)
{
    return attaches(motion) || motion.rescale != Rescale::None || motion.within || motion.limits.exist();
}

bool has_strength_or_direction(const MotionOptions& motion)
{
    return !motion.strength.empty() || motion.direction.kind != MotionDirection::Kind::Any;
}

constexpr std::string_view by_sweeps =
    "the steps of fields are solved exactly, and not by sweeps over sub-meshes: leave what concerns sweeps out";

constexpr FieldRule field_rules[]{
    {[](const FlowOfFields& o, const AskedOptions&) { return !is_symmetric(o.fields.laplacian); }, 0,
     "fields diffuse by a symmetric matrix, which the Laplacian {laplacian} does not have: use {symmetric}"},
    {[](const FlowOfFields& o, const AskedOptions&) { return o.flow.flow == FlowEquation::Conformalized; }, 0,
     "fields diffuse on a surface that stays, which the conformalized flow is not for: leave the flow out"},
    {[](const FlowOfFields& o, const AskedOptions&) { return o.flow.accuracy.approach == Approach::Sweep; }, 0,
     by_sweeps},
    {[](const FlowOfFields&, const AskedOptions&) { return true; }, concern::sweeps, by_sweeps},
    {[](const FlowOfFields& o, const AskedOptions&) { return moves_surface(o.flow.motion); }, 0,
     "fields diffuse on a surface that stays: leave attachments, rescale, within and limits out"},
    {[](const FlowOfFields& o, const AskedOptions&) { return has_strength_or_direction(o.flow.motion); }, 0,
     "fields diffuse on a surface that stays: leave strength and direction out"},
    {[](const FlowOfFields& o, const AskedOptions&) { return o.flow.report.reference; }, 0,
     "the steps of fields are solved exactly, so that there is nothing to compare with: leave <reference> out"},
    {[](const FlowOfFields& o, const AskedOptions&) {
         return o.fields.fwhm && (o.flow.time_step != 0.0 || o.flow.time_step_edges || o.flow.radius);
     },
     0, "<fwhm> and <time_step> or <radius> both say how much is smoothed: leave one of them out"},
};

}  // namespace

FieldOptions resolved(FieldOptions options, LengthScale& scale)
{
    if (!options.fwhm)
        return options;
    options.fwhm = scale.length_of(*options.fwhm);
    if (!(options.fwhm->value > 0.0))
        throw InputError(Wording{"the mesh has no size to measure a part of: give <fwhm> as a length"});
    return options;
}

void require_for_fields(const FlowOptions& options, const FieldOptions& of_fields)
{
    if (options.laplacian != FlowOptions().laplacian && options.laplacian != of_fields.laplacian)
        throw OptionError(fmt::format("the Laplacian of a flow is {}, but fields have one of their own, which is {}: "
                                      "choose it in FieldOptions",
                                      name_of(options.laplacian), name_of(of_fields.laplacian)));
    const auto require_positive = [](const std::optional<double>& value, const char* name, const char* what) {
        if (value && !(*value > 0.0 && std::isfinite(*value)))
            throw OptionError(fmt::format("{} is {}, but must be positive and finite ({})", name, *value, what));
    };
    if (of_fields.fwhm)
        require_positive(of_fields.fwhm->value, "fwhm", "a length");
    require_positive(of_fields.keep_edges, "the difference of fields to keep", "in the unit of the fields");
    require_none_broken<FlowOfFields>(field_rules, {options, of_fields}, changed_options(options),
                                      [&](std::string_view text, std::string_view other) {
                                          return fill_in({.laplacian = of_fields.laplacian}, text, other);
                                      });
}

FlowOptions flow_for_fields(const FlowOptions& options, const FieldOptions& of_fields)
{
    FlowOptions own = options;
    own.flow = FlowEquation::Linear;
    own.laplacian = of_fields.laplacian;
    own.motion.boundary = of_fields.boundary;
    own.report = {.record_schedule = options.report.record_schedule, .measures = false};
    if (of_fields.fwhm)
        own.time_step = time_for_fwhm(of_fields.fwhm->value, options) / std::max(options.steps, 1);
    if (!own.accuracy.tolerance && own.accuracy.approach != Approach::Undecomposed)
        own.accuracy.tolerance = default_field_tolerance;
    return own;
}

Weights weights_for_fields(const FieldOptions& of_fields)
{
    return of_fields.weights == Weights::AtLeastZero && of_fields.keep_edges ? Weights::AtLeastZeroInFaces
                                                                             : of_fields.weights;
}

}  // namespace seamflow
