#include "samples/report/surface_remarks.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "partition/text.h"

namespace seamflow {

namespace {

void remark_on_lost_cells(const std::vector<double>& before, const std::vector<double>& after,
                          std::vector<Remark>& remarks)
{
    constexpr double much = 0.2;
    std::size_t n_small = 0;
    for (std::size_t c = 0; c < before.size(); ++c)
        n_small += after[c] < (1.0 - much) * before[c] ? 1 : 0;
    if (n_small > 0)
        remarks.push_back(
            fmt::format("{} {} lost more than {:.0f}% of {} volume: less smoothing is gentler.",
                        before.size() == 1 ? "The only cell" : fmt::format("{} of {} cells", n_small, before.size()),
                        n_small == 1 ? "has" : "have", 100.0 * much, n_small == 1 ? "its" : "their"));
}

/// The loss of a body or of the whole surface that is worth a remark, as a fraction of its volume, or of its area where
/// it has no volume; 0 if it is small.
/// @param before, after with `volume` and `area`: BodySize or SurfaceLook.
template <class Size>
double large_loss(const Size& before, const Size& after)
{
    constexpr double much = 0.2;
    constexpr double most = 0.5;  // of the area: noise alone may have much of it
    const bool has_volume = before.volume && after.volume;
    const double lost = has_volume ? 1.0 - *after.volume / *before.volume : 1.0 - after.area / before.area;
    return lost > (has_volume ? much : most) ? lost : 0.0;
}

/// What helps, after a colon.
std::string remedies_of_loss(const AllOptions& options, const SurfaceChange& change)
{
    std::string remedies = "less smoothing is gentler";
    if (!change.before.volume)
        return remedies;
    const MotionOptions& motion = options.motion;
    const bool has_equation = !options.takes_whole_mesh() && options.scheme == Scheme::BackwardEuler;
    if (options.filter != Filter::LowPass && has_equation)
        remedies += ", --filter low-pass loses less";
    const bool moves_all =
        motion.fixed_vertices.empty() && motion.strength.empty() && motion.direction.kind == MotionDirection::Kind::Any;
    // A body that has become a point has no shape to scale back.
    const bool has_shapes =
        change.after.area > 0.0 &&
        std::ranges::none_of(change.after.bodies, [](const BodySize& body) { return body.area == 0.0; });
    if (change.before.cell_volumes.empty() && moves_all && has_shapes)
        remedies += change.before.bodies.empty() ? ", --rescale volume scales it back"
                                                 : ", --rescale volume scales each component back";
    return remedies;
}

}  // namespace

void remark_on_loss(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks)
{
    if (options.motion.rescale != Rescale::None)
        return;
    if (!change.before.cell_volumes.empty())
        remark_on_lost_cells(change.before.cell_volumes, change.after.cell_volumes, remarks);
    const std::string remedies = remedies_of_loss(options, change);
    const std::vector<BodySize>& before = change.before.bodies;
    std::size_t n_bodies = 0;
    double most = 0.0;
    for (std::size_t c = 0; c < before.size(); ++c)
        if (const double lost = large_loss(before[c], change.after.bodies[c]); lost > 0.0) {
            ++n_bodies;
            most = std::max(most, lost);
        }
    if (n_bodies > 0 && n_bodies < before.size()) {
        remarks.push_back(fmt::format("{} of {} components {} lost much, up to {:.0f}% of {} volume, or of the area of "
                                      "an open one: {}.",
                                      n_bodies, before.size(), n_bodies == 1 ? "has" : "have", 100.0 * most,
                                      n_bodies == 1 ? "its" : "their", remedies));
        return;
    }
    if (const double lost = large_loss(change.before, change.after); lost > 0.0)
        remarks.push_back(fmt::format("The surface has lost {:.0f}% of its {}: {}.", 100.0 * lost,
                                      change.before.volume && change.after.volume ? "volume" : "area", remedies));
}

void remark_on_folds(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks)
{
    if (change.overlaps > 0)
        remarks.push_back(
            fmt::format("Sheets lie on each other with different faces, at {}: the volumes of cells are not "
                        "known. They would be if such sheets had the same faces.",
                        counted(change.overlaps, "edge", "edges")));
    if (change.surfaces > 1 && !change.before.cell_volumes.empty())
        remarks.push_back(fmt::format("{} surfaces with cells do not touch: where one lies in a cell of another, it "
                                      "counts in the volume of that cell.",
                                      change.surfaces));
    std::string what;
    if (const std::size_t n = change.folded_faces.value_or(0); n > 0)
        what = fmt::format("{} turned over against neighbouring faces",
                           n == 1 ? "1 face has" : fmt::format("{} faces have", n));
    if (const std::size_t n = change.new_self_intersections.value_or(0); n > 0)
        what += fmt::format("{}{} of faces cross{} now that did not before", what.empty() ? "" : ", and ",
                            n == 1 ? "1 pair" : fmt::format("{} pairs", n), n == 1 ? "es" : "");
    if (!what.empty())
        remarks.emplace_back(
            what + ": smooth less, or pass " +
            (options.motion.within ? "a smaller --within." : "--within with a length below that of the edges there."));
}

}  // namespace seamflow
