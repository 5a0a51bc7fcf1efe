#include "solvers/rounding/rounded_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/connected_components.h"
#include "partition/metrics/edge_measures.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "solvers/rounding/joined_copies.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/normals_in_boxes.h"
#include "solvers/rounding/surface_parts.h"
#include "solvers/rounding/uncrossed_faces.h"

namespace seamflow {

namespace {

/// When rounding explains what is rough: if the fraction of bending that is left and the fraction of vertices near
/// their bounds, times a weight, add up to at most a limit.
struct Evidence {
    /// A vertex is near a bound if it has moved by this fraction of its width.
    double near;
    double weight;
    double most;

    /// @param fraction of the vertices that are near a bound. Where true places lie anywhere between the bounds, as
    /// those of heights do, 1 - near of them are.
    [[nodiscard]] double of(double fraction) const { return weight * std::max(fraction - (1.0 - near), 0.0); }
};

/// In brackets the sums of digitised shapes (balls, tori, tubes, boxes, plates, egg crates, terrains), then those of
/// shapes of blocks (pyramids of steps, studs, ribs, pockets), which are to stay. Stairs that a digitised plane could
/// be as well have sums of the first kind.
Evidence evidence_for(CoordinateBounds::Kind kind)
{
    switch (kind) {
    case CoordinateBounds::Kind::Heights:
        // [0.02 to 0.9; 0.93 to 3.3, and noise of 0.3 steps on steep ground 0.95]
        return {.near = 0.9, .weight = 3.2, .most = 0.9};
    case CoordinateBounds::Kind::MarchingCubes:
        // [0.15 to 0.79, one plate in thick slices 1.27; 0.83 to 1.3]
        return {.near = 0.98, .weight = 2.0, .most = 0.81};
    default:
        // [0.09 to 0.364; 0.37 to 1.3]
        return {.near = 0.9, .weight = 0.6, .most = 0.3675};
    }
}

/// A fairing ends when no coordinate moves by more than this many steps in an iteration.
constexpr double last_motion = 0.002;
constexpr int most_iterations = 400;

/// Whether a vertex has moved by at least the fraction `near` of its width, in a direction in which bounds are widest,
/// in steps; nothing for vertices with less than the whole bounds.
std::optional<bool> is_near_bound(const Boxes& boxes, const Point& steps, double near, const Points& positions, Index v)
{
    const Point motion = (positions.row(v) - boxes.middles.row(v)).cwiseAbs();
    const Point width = boxes.widths.row(v);
    const Point in_steps = (steps.array() > 0.0).select(width.array() / steps.array(), 0.0);
    // Within a part of the bounds, which a strength leaves, more vertices are near them.
    constexpr double nearly_half = 0.49;
    if (!(in_steps.maxCoeff() > nearly_half))
        return std::nullopt;
    return (in_steps.array() >= near * in_steps.maxCoeff() && motion.array() >= near * width.array()).any();
}

/// Per part: the fraction of the vertices with whole bounds that are near one; 1 without any: nothing shows that they
/// suffice.
std::vector<double> fractions_near_bounds(const SurfaceParts& parts, const Boxes& boxes, const CoordinateBounds& bounds,
                                          const Points& positions)
{
    std::vector<double> near(usize(parts.count()), 0.0);
    std::vector<double> all(usize(parts.count()), 0.0);
    const double fraction = evidence_for(bounds.kind).near;
    for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v)
        if (const Index part = parts.of_vertex(v); part >= 0)
            if (const auto is_near = is_near_bound(boxes, bounds.steps, fraction, positions, v)) {
                all[part] += 1.0;
                near[part] += *is_near ? 1.0 : 0.0;
            }
    for (std::size_t part = 0; part < all.size(); ++part)
        near[part] = all[part] > 0.0 ? near[part] / all[part] : 1.0;
    return near;
}

/// Takes the positions of the vertices of some parts.
void take(const SurfaceParts& parts, const std::vector<std::uint8_t>& taken, const Points& from, Points& positions,
          const Executor& exec)
{
    for_each(exec, static_cast<Index>(positions.rows()), [&](Index v) {
        if (const Index part = parts.of_vertex(v); part >= 0 && taken[part] != 0)
            positions.row(v) = from.row(v);
    });
}

bool begins_with_fairing(const CoordinateBounds& bounds)
{
    return bounds.kind != CoordinateBounds::Kind::MarchingCubes || !has_equal_steps(bounds.steps);
}

/// The bounds of vertices that may move.
/// @param neighbours #V: the vertices that share an edge with each vertex.
CoordinateBounds bounds_for(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                            const Points& positions, const RoundedMotion& motion, const Executor& exec)
{
    const double length = mean_edge_length(mesh, positions, exec);
    CoordinateBounds bounds = motion.given_steps ? bounds_of(positions, neighbours, length, *motion.given_steps, exec)
                                                 : bounds_of(positions, neighbours, length, exec);
    if (bounds.kind == CoordinateBounds::Kind::None)
        return bounds;
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double strength = motion.strengths.empty() ? 1.0 : motion.strengths[v];
        bounds.widths.row(v) =
            topology.moves(v) ? Point(strength * bounds.widths.row(v).cwiseProduct(motion.axes)) : Point::Zero();
    });
    return bounds;
}

/// The surface within bounds that bends less of the two, for each part.
class SmootherSurface {
  public:
    /// @param components those of the faces. @param volumes those that are kept. All must outlive the object.
    SmootherSurface(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                    const KeptVolumes& volumes, const Boxes& boxes, const Executor& exec)
        : mesh_(mesh)
        , topology_(topology)
        , boxes_(boxes)
        , exec_(exec)
        , parts_(mesh, topology, components)
        , normals_(mesh, topology, parts_, volumes, boxes_, exec)
    {
    }

    /// Smooths normals. @param positions #V by 3: in the boxes; replaced.
    void smooth(Points& positions)
    {
        const Points fair = positions;
        Points with_edges = fair;
        bending_ = normals_.smooth(NormalNeighbours::All, positions);
        const std::vector<double> of_edges = normals_.smooth(NormalNeighbours::SameSideOfEdge, with_edges, bending_);
        std::vector<std::uint8_t> taken(bending_.size(), 0);
        for (std::size_t part = 0; part < bending_.size(); ++part)
            if (!NormalsInBoxes::bends_no_less(of_edges[part], bending_[part])) {
                taken[part] = 1;
                bending_[part] = of_edges[part];
            }
        take(parts_, taken, with_edges, positions, exec_);
        uncross_faces(mesh_, topology_, fair, boxes_, positions, exec_);
    }

    /// Puts parts back whose roughness the rounding does not explain. @param positions the result of `smooth`.
    /// @returns #V: 1 at their vertices; empty if it explains that of no part.
    [[nodiscard]] std::vector<std::uint8_t> put_back_unexplained(const CoordinateBounds& bounds,
                                                                 Points& positions) const
    {
        const std::vector<double> before = normals_.bending(boxes_.middles);
        const std::vector<double> near = fractions_near_bounds(parts_, boxes_, bounds, positions);
        const Evidence evidence = evidence_for(bounds.kind);
        std::vector<std::uint8_t> is_unexplained(bending_.size(), 0);
        for (std::size_t part = 0; part < bending_.size(); ++part)
            if (!(before[part] > 0.0 && bending_[part] / before[part] + evidence.of(near[part]) <= evidence.most))
                is_unexplained[part] = 1;
        if (std::ranges::find(is_unexplained, 0) == is_unexplained.end())
            return {};
        take(parts_, is_unexplained, boxes_.middles, positions, exec_);
        std::vector<std::uint8_t> of_vertices(usize(mesh_.n_vertices()), 0);
        for_each(exec_, mesh_.n_vertices(), [&](Index v) {
            if (const Index part = parts_.of_vertex(v); part >= 0)
                of_vertices[v] = is_unexplained[part];
        });
        return of_vertices;
    }

  private:
    const PolygonMesh& mesh_;
    const Topology& topology_;
    Boxes boxes_;
    const Executor& exec_;
    SurfaceParts parts_;
    NormalsInBoxes normals_;
    /// The bending of each part of the smoothed surface.
    std::vector<double> bending_;
};

/// A surface within bounds, of which all parts move, or those whose roughness the rounding explains.
/// @param neighbours #V: the vertices that share an edge with each vertex. @param motion which steps are given.
/// @returns nothing if no part moves.
std::optional<SmoothedWithinSteps> smooth_within(const PolygonMesh& mesh, const Topology& topology,
                                                 const Components& components, const KeptVolumes& volumes,
                                                 const IndexLists& neighbours, const Points& positions,
                                                 const CoordinateBounds& bounds, const RoundedMotion& motion,
                                                 const Executor& exec)
{
    const Boxes boxes{positions, bounds.widths};
    SmoothedWithinSteps result{.positions = positions, .steps = bounds.steps};
    const double smallest_step = (bounds.steps.array() > 0.0).select(bounds.steps, bounds.steps.maxCoeff()).minCoeff();
    if (begins_with_fairing(bounds))
        result.fairing =
            fair_in_boxes(neighbours, boxes, {most_iterations, last_motion * smallest_step}, result.positions, exec);
    result.fairing.last_motion /= smallest_step;
    SmootherSurface smoother(mesh, topology, components, volumes, boxes, exec);
    smoother.smooth(result.positions);
    if (motion.given_steps)
        return result;
    result.is_unexplained = smoother.put_back_unexplained(bounds, result.positions);
    return result.is_unexplained.empty() ? std::nullopt : std::optional(std::move(result));
}

/// Smooths a surface whose components touch: copies of a vertex move as one.
/// @param volumes of the components.
std::optional<SmoothedWithinSteps> smooth_joined(const JoinedCopies& joined, KeptVolumes& volumes,
                                                 const Points& positions, CoordinateBounds bounds,
                                                 const RoundedMotion& motion, const Executor& exec)
{
    const std::vector<Index>& original_of = joined.original_of;
    const auto n = static_cast<Index>(original_of.size());
    for (Index v = 0; v < n; ++v)
        if (const Index original = original_of[v]; original != v) {
            volumes.hold(original);
            bounds.widths.row(original) = bounds.widths.row(original).cwiseMin(bounds.widths.row(v));
        }
    Topology topology = make_topology(joined.mesh, exec);
    free_junctions(joined.mesh, topology, exec);
    std::optional<SmoothedWithinSteps> result =
        smooth_within(joined.mesh, topology, face_components(joined.mesh, topology), volumes,
                      VertexAverages(joined.mesh, topology, exec).neighbours(), positions, bounds, motion, exec);
    if (result)
        for_each(exec, n, [&](Index v) {
            if (const Index original = original_of[v]; original != v) {
                result->positions.row(v) = result->positions.row(original);
                if (!result->is_unexplained.empty())
                    result->is_unexplained[v] = result->is_unexplained[original];
            }
        });
    return result;
}

}  // namespace

std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const RoundedMotion& motion,
                                                  const Executor& exec)
{
    std::vector<Spike> spikes = find_spikes(mesh, positions, exec);
    const Points filled = spikes.empty() ? positions : without_spikes(mesh, topology, spikes, positions);
    const IndexLists neighbours = VertexAverages(mesh, topology, exec).neighbours();
    const CoordinateBounds bounds = bounds_for(mesh, topology, neighbours, filled, motion, exec);
    if (bounds.kind == CoordinateBounds::Kind::None || (!motion.given_steps && bounds.widths.isZero(0.0)))
        return std::nullopt;
    const Components components = face_components(mesh, topology);
    const std::optional<JoinedCopies> joined = join_copies(mesh, topology, components, filled, exec);
    KeptVolumes volumes(joined ? joined->all_faces : mesh, topology, components, filled, exec);
    std::optional<SmoothedWithinSteps> result =
        joined ? smooth_joined(*joined, volumes, filled, bounds, motion, exec)
               : smooth_within(mesh, topology, components, volumes, neighbours, filled, bounds, motion, exec);
    if (!result)
        return std::nullopt;
    for (const Spike& spike : spikes)
        result->positions.row(spike.vertex) = positions.row(spike.vertex);
    result->spikes = std::move(spikes);
    return result;
}

std::string steps_in_words(const Point& steps)
{
    // Steps that are found differ by rounding.
    constexpr double equal = 1e-6;
    if (steps.maxCoeff() - steps.minCoeff() <= equal * steps.maxCoeff())
        return fmt::format("{:.6g} in x, y and z", steps.maxCoeff());
    constexpr std::string_view axes = "xyz";
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
        if (steps[axis] > 0.0)
            text += fmt::format("{}{:.6g} in {}", text.empty() ? "" : ", ", steps[axis],
                                axes[static_cast<std::size_t>(axis)]);
    return text;
}

}  // namespace seamflow
