#include "engine/motion/resolved_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/metrics/feathered.h"

namespace seamflow {

namespace {

void resolve(std::optional<LengthOnMesh>& length, LengthScale& scale)
{
    if (length)
        length = scale.length_of(*length);
}

/// 1/R², in 1/length².
double attachment_of(const LengthOnMesh& radius, LengthScale& scale)
{
    if (radius.of_diagonal && !std::isnormal(scale.diagonal()))
        throw InputError(Wording{"the mesh has no size to measure <attachment> by; use a length"});
    const double length = scale.length_of(radius);
    const double weight = 1.0 / (length * length);
    if (!std::isnormal(weight))
        throw OptionError(Wording{"<attachment> is too small or too large: 1/R² is beyond what a double can hold"});
    return weight;
}

/// Lets the strengths rise from the rim of their region.
void feather(MotionOptions& motion, double length, const PolygonMesh& mesh, const Executor& exec,
             std::vector<Remark>& remarks)
{
    std::vector<double>& strength = motion.strength;
    const auto largest = [&] { return strength.empty() ? 0.0 : std::ranges::max(strength); };
    const double given = largest();
    const std::optional<double> weld = motion.weld ? std::optional(motion.weld->value) : std::nullopt;
    strength = feathered(mesh, std::move(strength), length, weld, exec);
    constexpr double little = 0.9;
    if (largest() < little * given)
        remarks.push_back({"shallow region",
                           {{"part of the strength", largest() / given}},
                           {fmt::format("The region is less deep than <feather> is long: nowhere is there more than "
                                        "{:.2g}% of the strength. Give a shorter <feather>.",
                                        100.0 * largest() / given)}});
}

/// Whether the area that results would get back is that of noise: where a run chooses how much to smooth, which the
/// volume limits. Scaled to it, the surface would be blown up.
bool restores_area_of_noise(const MotionOptions& motion)
{
    return motion.rescale == Rescale::Area && std::isfinite(motion.limits.volume);
}

}  // namespace

MotionOptions with_lengths(MotionOptions motion, LengthScale& scale)
{
    for (std::optional<LengthOnMesh>* const length : {&motion.weld, &motion.feather})
        resolve(*length, scale);
    if (motion.within)
        for (LengthOnMesh& length : motion.within->lengths)
            length = scale.length_of(length);
    if (motion.attachment_radius) {
        motion.attachment = attachment_of(*motion.attachment_radius, scale);
        motion.attachment_radius.reset();
    }
    if (restores_area_of_noise(motion))
        motion.rescale = Rescale::None;
    return motion;
}

MotionOptions resolved(MotionOptions motion, const PolygonMesh& mesh, LengthScale& scale, const Executor& exec,
                       std::vector<Remark>& remarks)
{
    if (restores_area_of_noise(motion))
        remarks.push_back({"area not restored",
                           {},
                           {"The area was not restored, because volumes are to stay nearly as they are: with the area "
                            "of its noise the surface would be blown up. <rescale volume> restores volumes."}});
    MotionOptions own = with_lengths(std::move(motion), scale);
    if (own.feather) {
        require_valid(mesh, exec);
        feather(own, own.feather->value, mesh, exec, remarks);
        own.feather.reset();
    }
    return own;
}

}  // namespace seamflow
