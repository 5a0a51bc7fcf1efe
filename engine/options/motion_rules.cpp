#include "engine/options/motion_rules.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

using Asked = AskedOptions;

bool is_rescaled(const MotionOptions& motion)
{
    return motion.rescale != Rescale::None;
}

bool is_sound(const MotionDirection& direction)
{
    const Point& v = direction.vector;
    return direction.kind != MotionDirection::Kind::Vector ||
           (v.allFinite() && v.norm() > 0.0 && std::isfinite(v.norm()));
}

bool has_direction(const MotionOptions& motion)
{
    return motion.direction.kind != MotionDirection::Kind::Any;
}

constexpr OptionRule<MotionOptions> of_motion[]{
    {[](const MotionOptions& m, const Asked&) { return !is_sound(m.direction); }, 0,
     "<direction> must be a finite vector other than 0, like 0,0,1"},
    {[](const MotionOptions& m, const Asked& asked) {
         return asked.has("feature_edges") && (is_rescaled(m) || asked.has("within"));
     },
     0, "<rescale> and <within> move vertices off <feature_edges>: leave them out"},
    {[](const MotionOptions& m, const Asked& asked) { return is_rescaled(m) && asked.has("fixed_vertices"); }, 0,
     "<rescale> moves every vertex, but <fixed_vertices> holds some: leave <rescale> out; <filter low-pass>, which "
     "hardly shrinks large features, lets them stay"},
    {[](const MotionOptions& m, const Asked& asked) { return is_rescaled(m) && asked.has("strength"); }, 0,
     "<rescale> moves every vertex, but those with a <strength> of 0 are to stay: leave one of them out"},
    {[](const MotionOptions& m, const Asked& asked) {
         return has_direction(m) && (is_rescaled(m) || asked.has("feature_edges"));
     },
     0,
     "<direction> lets vertices move along lines alone, which <rescale> and <feature_edges> do not: leave one of them "
     "out"},
    {[](const MotionOptions&, const Asked& asked) {
         return (asked.has("attachment") || asked.has("attachment_radius")) && asked.has("attachment_weights");
     },
     0, "<attachment> and <attachment_weights> both say how vertices are attached: leave one of them out"},
    {[](const MotionOptions& m, const Asked&) { return m.attachment > 0.0 && m.attachment_radius; }, 0,
     "attachment and attachment_radius both say how vertices are attached: leave one of them out"},
    {[](const MotionOptions&, const Asked& asked) { return asked.has("feather") && !asked.has("strength"); }, 0,
     "<feather> is for the rim of a region: give <strength> as well"},
};

}  // namespace

std::string fill_other(std::string_view text, std::string_view other)
{
    return fmt::format(fmt::runtime(text), fmt::arg("other", other));
}

void refuse(std::string text)
{
    throw OptionError(Wording{std::move(text)});
}

void require_compatible(const MotionOptions& motion, const AskedOptions& asked)
{
    require_none_broken<MotionOptions>(of_motion, motion, asked, fill_other);
}

void require_valid_vertex_values(const MotionOptions& motion)
{
    const std::vector<double>& weights = motion.attachment_weights;
    const auto heavy = std::ranges::find_if_not(weights, [](double w) { return w >= 0.0 && std::isfinite(w); });
    if (heavy != weights.end())
        throw InputError(fmt::format("the attachment weight of vertex {} is {:.17g}, but must be at least 0 and finite "
                                     "(1/length²)",
                                     heavy - weights.begin(), *heavy));
    const std::vector<double>& strength = motion.strength;
    const auto wrong = std::ranges::find_if_not(strength, [](double s) { return s >= 0.0 && s <= 1.0; });
    if (wrong != strength.end())
        throw InputError(fmt::format("the strength of vertex {} is {:.17g}, but must be from 0 to 1",
                                     wrong - strength.begin(), *wrong));
}

}  // namespace seamflow
