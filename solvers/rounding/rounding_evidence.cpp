#include "solvers/rounding/rounding_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// When rounding explains what is rough: if the fraction of bending that is left and the fraction of vertices near
/// their bounds, times a weight, add up to at most a limit; or if few vertices are near bounds, and less is left than a
/// limit of its own.
struct Evidence {
    /// A vertex is near a bound if it has moved by this fraction of its half-width.
    double near;
    /// The weight and the limit of the sum.
    double weight;
    double most;
    /// The fraction of vertices near bounds that is few, and the limit of bending with it.
    double few;
    double most_with_few;
    /// The fraction of vertices at corners of voxels that the second limit needs.
    double corners = 0.0;

    /// Whether the sum is small enough. @param bending the fraction that is left. @param fraction of the vertices that
    /// are near a bound. Where true places lie anywhere between the bounds, as those of heights do, 1 - near of them
    /// are.
    [[nodiscard]] bool explains(double bending, double fraction) const
    {
        return bending + weight * std::max(fraction - (1.0 - near), 0.0) <= most;
    }

    /// The same by the second limit.
    [[nodiscard]] bool explains_with_few(double bending, double fraction) const
    {
        return fraction <= few && bending <= most_with_few;
    }
};

/// The comments give measured sums as [digitised shapes; shapes made of blocks]. Digitised shapes (balls, tori, tubes,
/// boxes, plates, egg crates, terrains) are to be smoothed. Shapes made of blocks (pyramids of steps, studs, ribs,
/// pockets) are to stay. Stairs that a digitised plane could be as well have sums of the first kind.
Evidence evidence_for(const CoordinateBounds& bounds)
{
    constexpr double fine = 0.5;
    switch (bounds.kind) {
    case CoordinateBounds::Kind::Heights:
        // [0.02 to 0.9; 0.93 to 3.3, and noise of 0.3 steps on steep ground 0.95]
        return {.near = 0.9, .weight = 3.2, .most = 0.9, .few = 0.0, .most_with_few = 0.0};
    case CoordinateBounds::Kind::MarchingCubes:
        // [0.15 to 0.79, one plate in thick slices 1.27; 0.83 to 1.3]. Thin vessels keep .8 to .96 of their bending,
        // but less than 0.035 of their vertices are near bounds; of shapes of blocks 0.056 are.
        return {.near = 0.98, .weight = 2.0, .most = 0.81, .few = 0.04, .most_with_few = 0.97};
    default:
        // Steps much shorter than edges make no blocks: what bends less within them was rounded, or has noise, of which
        // more vertices are near bounds. Of boxes, balls, gears and threads [0.08 to 0.82 is left, 0.31 to 0.53 near;
        // clean 0.999 and more is left, with noise of half a step 0.57 and more near]
        if (bounds.steps.maxCoeff() < fine * bounds.edge)
            return {.near = 0.9, .weight = 0.0, .most = 0.0, .few = 0.56, .most_with_few = 0.9};
        // [0.09 to 0.364; 0.37 to 1.3]. Thin vessels and small balls keep 0.3 to 0.53, with 0.18 to 0.33 near bounds,
        // or 0.42 where they are cut off, and 0.44 to 0.6 at corners. Of shapes of blocks that keep as little, at most
        // 0.32 are, but for single blocks that touch at edges and corners, which keep 0.8.
        return {.near = 0.9, .weight = 0.6, .most = 0.3675, .few = 0.45, .most_with_few = 0.55, .corners = 0.4};
    }
}

/// Whether a vertex has moved by at least the fraction `near` of its half-width, in a direction in which bounds are
/// widest, in steps; nothing for vertices with less than the whole bounds.
std::optional<bool> is_near_bound(const Boxes& boxes, const Point& steps, double near, const Points& positions, Index v)
{
    if (!boxes.flat.empty() && boxes.flat[v] != 0)
        return std::nullopt;
    const Point motion = (positions.row(v) - boxes.middles.row(v)).cwiseAbs();
    const Point half_width = boxes.half_widths.row(v);
    const Point in_steps = (steps.array() > 0.0).select(half_width.array() / steps.array(), 0.0);
    // Within a part of the bounds, which a strength leaves, more vertices are near them.
    constexpr double nearly_half = 0.49;
    if (!(in_steps.maxCoeff() > nearly_half))
        return std::nullopt;
    return (in_steps.array() >= near * in_steps.maxCoeff() && motion.array() >= near * half_width.array()).any();
}

/// Per part: of the vertices for which a property is known, the fraction that has it; 1 if it is known of none.
/// @param has gives an optional bool for each vertex.
template <class Has>
std::vector<double> fractions_with(const SurfaceParts& parts, Index n_vertices, Has&& has)
{
    std::vector<double> with(usize(parts.count()), 0.0);
    std::vector<double> all(usize(parts.count()), 0.0);
    for (Index v = 0; v < n_vertices; ++v)
        if (const Index part = parts.of_vertex(v); part >= 0)
            if (const std::optional<bool> known = has(v)) {
                all[part] += 1.0;
                with[part] += *known ? 1.0 : 0.0;
            }
    for (std::size_t part = 0; part < all.size(); ++part)
        with[part] = all[part] > 0.0 ? with[part] / all[part] : 1.0;
    return with;
}

/// The corners of voxels on a surface, and the planes of its faces.
class VoxelFaces {
  public:
    VoxelFaces(const SurfaceParts& parts, const Points& points, const Point& steps)
        : steps_(steps)
        , axes_(static_cast<std::size_t>(points.rows()), 0)
        , planes_(usize(parts.count()))
    {
        constexpr double nearly_one = 0.999;
        const PolygonMesh& mesh = parts.mesh();
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            const Point area = vector_area(mesh.face(f), points);
            for (unsigned axis = 0; axis < 3; ++axis) {
                if (!(std::abs(area[axis]) > nearly_one * area.norm()))
                    continue;
                for (const Index v : mesh.face(f))
                    axes_[usize(v)] = static_cast<std::uint8_t>(axes_[usize(v)] | 1U << axis);
                add_plane(planes_[usize(parts.of_face(f))][axis], axis, points(mesh.face(f).front(), axis));
            }
        }
    }

    /// Whether a vertex belongs to faces across all three axes.
    [[nodiscard]] bool is_corner(Index v) const
    {
        constexpr unsigned all_axes = 7;
        return axes_[usize(v)] == all_axes;
    }

    /// Whether the faces of a part across one axis lie in two planes: a picture of blocks, made thicker.
    [[nodiscard]] bool is_extruded(std::size_t part) const
    {
        return std::ranges::any_of(planes_[part], [](const Planes& planes) { return planes.size() <= 2; });
    }

  private:
    /// Different planes across one axis, no more than three.
    using Planes = std::vector<double>;

    void add_plane(Planes& planes, unsigned axis, double place) const
    {
        const auto is_same = [&](double other) { return std::abs(other - place) < 0.5 * steps_[axis]; };
        if (planes.size() <= 2 && std::ranges::none_of(planes, is_same))
            planes.push_back(place);
    }

    Point steps_;
    /// #V: bit k is 1 at vertices of faces across axis k.
    std::vector<std::uint8_t> axes_;
    /// Per part and axis.
    std::vector<std::array<Planes, 3>> planes_;
};

}  // namespace

std::vector<std::uint8_t> parts_explained_by_rounding(const SurfaceParts& parts, const CoordinateBounds& bounds,
                                                      const Boxes& boxes, const Points& positions, bool knows_vessels,
                                                      const Executor& exec)
{
    const auto n_vertices = static_cast<Index>(positions.rows());
    const Evidence evidence = evidence_for(bounds);
    const std::vector<double> before = parts.bending(boxes, boxes.middles, exec);
    const std::vector<double> after = parts.bending(boxes, positions, exec);
    // 1 where no vertex has whole bounds: nothing shows that they suffice.
    const std::vector<double> near = fractions_with(
        parts, n_vertices, [&](Index v) { return is_near_bound(boxes, bounds.steps, evidence.near, positions, v); });
    // Diagonals of the faces of voxels bend only once these are smooth: 1.14 to 1.32 times as much for vessels.
    constexpr double bending_of_diagonals = 1.2;
    const PolygonMesh& mesh = parts.mesh();
    const bool has_diagonals = evidence.corners > 0.0 && mesh.n_corners() < 4 * mesh.n_faces();
    const double more_bending = has_diagonals ? bending_of_diagonals : 1.0;
    std::vector<std::uint8_t> explained(before.size(), 0);
    std::vector<std::uint8_t> may_be_vessel(before.size(), 0);
    for (std::size_t part = 0; part < before.size(); ++part)
        if (before[part] > 0.0) {
            const double bending = after[part] / before[part];
            explained[part] = evidence.explains(bending, near[part]) ? 1 : 0;
            may_be_vessel[part] = evidence.explains_with_few(bending / more_bending, near[part]) ? 1 : 0;
        }
    if (std::ranges::find(may_be_vessel, 1) == may_be_vessel.end())
        return explained;
    if (evidence.corners > 0.0) {
        const VoxelFaces faces(parts, boxes.middles, bounds.steps);
        const std::vector<double> corners =
            fractions_with(parts, n_vertices, [&](Index v) { return std::optional(faces.is_corner(v)); });
        for (std::size_t part = 0; part < corners.size(); ++part)
            if (!knows_vessels || corners[part] < evidence.corners || faces.is_extruded(part))
                may_be_vessel[part] = 0;
    }
    for (std::size_t part = 0; part < explained.size(); ++part)
        explained[part] = std::max(explained[part], may_be_vessel[part]);
    return explained;
}

}  // namespace seamflow
