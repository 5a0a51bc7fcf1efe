#include "engine/fields/field_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

double time_for_fwhm(double fwhm)
{
    return fwhm * fwhm / (16.0 * std::numbers::ln2);
}

double fwhm_for_time(double time)
{
    return std::sqrt(16.0 * std::numbers::ln2 * time);
}

void require_for_fields(const FlowOptions& options, const FieldOptions& of_fields)
{
    const auto refuse = [](std::string_view what, std::string_view remedy) {
        throw OptionError(fmt::format("{}: leave {} out", what, remedy));
    };
    if (options.laplacian != FlowOptions().laplacian && options.laplacian != of_fields.laplacian)
        throw OptionError(fmt::format("the Laplacian of a flow is {}, but fields have one of their own, which is {}: "
                                      "choose it in FieldOptions",
                                      name_of(options.laplacian), name_of(of_fields.laplacian)));
    if (!is_symmetric(of_fields.laplacian))
        throw OptionError(fmt::format("fields diffuse by a symmetric matrix, which the Laplacian {} does not have: use "
                                      "{}",
                                      name_of(of_fields.laplacian), names_of_symmetric_laplacians()));
    if (options.flow == FlowEquation::Conformalized)
        refuse("fields diffuse on a surface that stays, which the conformalized flow is not for", "the flow");
    if (options.accuracy.approach == Approach::Sweep || !first_set(options, concern::sweeps).empty())
        refuse("the steps of fields are solved exactly, and not by sweeps over sub-meshes", "what concerns sweeps");
    const MotionOptions& motion = options.motion;
    if (attaches(motion) || motion.rescale != Rescale::None || motion.within || motion.limits.exist())
        refuse("fields diffuse on a surface that stays", "attachments, rescale, within and limits");
    if (!motion.strength.empty() || motion.direction.kind != MotionDirection::Kind::Any)
        refuse("fields diffuse on a surface that stays", "strength and direction");
    if (options.keep_edges)
        refuse("keep_edges is about the angles of a surface, which stays while fields diffuse", "it");
    if (options.report.reference)
        refuse("the steps of fields are solved exactly, so that there is nothing to compare with", "reference");
    const auto require_positive = [](const std::optional<double>& value, const char* name, const char* what) {
        if (value && !(*value > 0.0 && std::isfinite(*value)))
            throw OptionError(fmt::format("{} is {}, but must be positive and finite ({})", name, *value, what));
    };
    require_positive(of_fields.fwhm, "fwhm", "a length");
    require_positive(of_fields.keep_edges, "the difference of fields to keep", "in the unit of the fields");
    if (of_fields.fwhm && (options.time_step != 0.0 || options.radius))
        throw OptionError("fwhm and time_step or radius both say how much is smoothed: leave one of them out");
}

FlowOptions flow_for_fields(const FlowOptions& options, const FieldOptions& of_fields)
{
    FlowOptions own = options;
    own.flow = FlowEquation::Linear;
    own.laplacian = of_fields.laplacian;
    own.weights = of_fields.weights == Weights::AtLeastZero && of_fields.keep_edges ? Weights::AtLeastZeroInFaces
                                                                                    : of_fields.weights;
    own.motion.boundary = of_fields.boundary;
    own.report = {.record_schedule = options.report.record_schedule, .measures = false};
    if (of_fields.fwhm)
        own.time_step = time_for_fwhm(*of_fields.fwhm) / std::max(options.steps, 1);
    if (!own.accuracy.tolerance && own.accuracy.approach != Approach::Undecomposed)
        own.accuracy.tolerance = default_field_tolerance;
    return own;
}

}  // namespace seamflow
