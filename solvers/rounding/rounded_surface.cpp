#include "solvers/rounding/rounded_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/connected_components.h"
#include "partition/metrics/edge_measures.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/joined_copies.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/uncrossed_faces.h"

namespace seamflow {

namespace {

/// The chords of unit normals over which normals are averaged: between all neighbours, and on one side of an edge.
constexpr float all_normals = 1.5F;
constexpr float same_side = 0.3F;
/// A group is the last if it has taken less than this fraction of the bending.
constexpr double least_gain = 0.002;
/// Normals are averaged and vertices fitted to them this many times, in groups, until a group makes the surface bend no
/// less; and the rounds of averaging and of fitting each time.
constexpr int n_groups = 4;
constexpr int group_of_fits = 4;
constexpr int averaging_rounds = 3;
constexpr int fitting_rounds = 10;
/// The surface that keeps edges is taken if its bending is below this fraction of that of the other one.
constexpr double bends_less = 0.98;
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
        // [0.02 to 0.81; above 1.3]
        return {.near = 0.9, .weight = 3.0, .most = 0.9};
    case CoordinateBounds::Kind::MarchingCubes:
        // [0.15 to 0.73, one plate in thick slices 1.2; 0.82 to 1.3]
        return {.near = 0.98, .weight = 2.0, .most = 0.75};
    default:
        // [0.12 to 0.445; 0.625 to 1.1, and pyramids of steps 1 by 3 and 3 by 1 0.455 and 0.466]
        return {.near = 0.98, .weight = 1.0, .most = 0.45};
    }
}

/// A fairing ends when no coordinate moves by more than this many steps in an iteration.
constexpr double last_motion = 0.002;
constexpr int most_iterations = 400;

/// The parts of a surface that are judged one by one: its components, but for small ones, which are one part together.
class Parts {
  public:
    Parts(const PolygonMesh& mesh, const Topology& topology, const Components& components)
        : mesh_(mesh)
        , topology_(topology)
        , components_(components)
        , part_of_(usize(components.count()), 0)
    {
        for (Index c = 0; c < components.count(); ++c)
            if (components.nodes[c].size() >= small_component)
                part_of_[c] = count_++;
    }

    [[nodiscard]] Index count() const { return count_; }

    /// The part of the first face of a vertex; -1 for vertices without faces.
    [[nodiscard]] Index of_vertex(Index v) const
    {
        const auto corners = topology_.corners_at(v);
        return corners.empty() ? -1 : part_of_[components_.component_of[topology_.face_of[corners.front()]]];
    }

    /// The total bending of each part: Σ l θ over its edges of two faces, with the length l and the angle θ between the
    /// normals of the faces. It is the same for a convex body and its rounded copies, however sharp its edges are, and
    /// grows with every wave: what stairs add to it disappears with them. Edges of vertices without bounds do not
    /// count.
    [[nodiscard]] std::vector<double> bending(const Points& widths, const Points& positions, const Executor& exec) const
    {
        std::vector<double> of_halfedges(usize(mesh_.n_corners()));
        for_each(exec, mesh_.n_corners(), [&](Index h) { of_halfedges[h] = bending_at(h, widths, positions); });
        std::vector<double> of_parts(usize(count_), 0.0);
        for (Index h = 0; h < mesh_.n_corners(); ++h)
            of_parts[part_of_[components_.component_of[topology_.face_of[h]]]] += of_halfedges[h];
        return of_parts;
    }

  private:
    static constexpr std::size_t small_component = 200;

    [[nodiscard]] double bending_at(Index h, const Points& widths, const Points& positions) const
    {
        const Index twin = topology_.twin[h];
        if (twin < h)
            return 0.0;
        const Index v = mesh_.face_vertices[h];
        const Index w = mesh_.face_vertices[topology_.next(mesh_, h)];
        if (widths.row(v).isZero(0.0) || widths.row(w).isZero(0.0))
            return 0.0;
        const Point normal = vector_area(mesh_.face(topology_.face_of[h]), positions);
        Point other = vector_area(mesh_.face(topology_.face_of[twin]), positions);
        // Half-edges in the same direction belong to faces with opposite orientations.
        if (mesh_.face_vertices[twin] == v)
            other = -other;
        const double sine = Eigen::RowVector3d(normal.cross(other)).norm();
        return (positions.row(w) - positions.row(v)).norm() * std::atan2(sine, normal.dot(other));
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const Components& components_;
    /// Per component. Part 0 has the small ones.
    std::vector<Index> part_of_;
    Index count_ = 1;
};

double total(const std::vector<double>& of_parts)
{
    return std::accumulate(of_parts.begin(), of_parts.end(), 0.0);
}

/// Whether a part with edges that are kept bends hardly less than it does without.
bool bends_no_less(double with_edges, double without)
{
    return !(with_edges < bends_less * without);
}

/// Smooths the normals of a surface within bounds.
class NormalsInBoxes {
  public:
    NormalsInBoxes(const PolygonMesh& mesh, const Topology& topology, const Parts& parts, const KeptVolumes& volumes,
                   const Boxes& boxes, const Executor& exec)
        : mesh_(mesh)
        , topology_(topology)
        , parts_(parts)
        , volumes_(volumes)
        , boxes_(boxes)
        , exec_(exec)
        , averages_(mesh, topology, exec, Sheets::Own)
    {
    }

    /// Averages normals over chords of `sigma` and fits the vertices to them, several times.
    /// @param of_other the bending of each part of another surface: there are no further groups if after the first one
    /// no part bends clearly less. Empty: no other surface.
    /// @returns the bending of each part of the result.
    std::vector<double> smooth(float sigma, Points& positions, const std::vector<double>& of_other = {})
    {
        std::vector<double> least = bending(positions);
        for (int group = 0; group < n_groups; ++group) {
            Points further = positions;
            for (int i = 0; i < group_of_fits; ++i)
                smooth_once(sigma, further);
            std::vector<double> of_further = bending(further);
            // The first group may bend a surface more that is to become one with edges.
            const double gain = total(least) - total(of_further);
            if (group > 0 && !(gain > 0.0))
                break;
            least = std::move(of_further);
            positions = std::move(further);
            if (group > 0 && gain < least_gain * total(least))
                break;
            if (group == 0 && !of_other.empty() && std::ranges::equal(least, of_other, bends_no_less))
                break;
        }
        return least;
    }

    [[nodiscard]] std::vector<double> bending(const Points& positions) const
    {
        return parts_.bending(boxes_.widths, positions, exec_);
    }

  private:
    void smooth_once(float sigma, Points& positions)
    {
        averages_.measure(positions, exec_);
        averages_.measure_normals(positions, normals_, exec_);
        for (int round = 0; round < averaging_rounds; ++round) {
            averages_.average(sigma, normals_, means_, exec_);
            normalise(means_, exec_);
            normals_.swap(means_);
        }
        fit(positions);
        volumes_.restore(boxes_, positions, exec_);
    }

    /// Moves each vertex, again and again, by the mean of n ⟨n, c - x⟩ over its faces with averaged normals n and
    /// centroids c, as far as its box allows (Sun et al., Fast and effective feature-preserving mesh denoising, 2007).
    void fit(Points& positions) const
    {
        Points centroids(mesh_.n_faces(), 3);
        for (int round = 0; round < fitting_rounds; ++round) {
            for_each(exec_, mesh_.n_faces(), [&](Index f) {
                Point total = Point::Zero();
                for (const Index v : mesh_.face(f))
                    total += positions.row(v);
                centroids.row(f) = total / static_cast<double>(mesh_.face(f).size());
            });
            for_each(exec_, mesh_.n_vertices(), [&](Index v) {
                const Point position = positions.row(v);
                Point total = Point::Zero();
                const auto corners = topology_.corners_at(v);
                for (const Index corner : corners) {
                    const Index f = topology_.face_of[corner];
                    const Point normal = normals_.row(f).head<3>().cast<double>();
                    total += normal * normal.dot(centroids.row(f) - position);
                }
                if (!corners.empty())
                    positions.row(v) = boxes_.nearest(v, position + total / static_cast<double>(corners.size()));
            });
        }
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const Parts& parts_;
    const KeptVolumes& volumes_;
    const Boxes& boxes_;
    const Executor& exec_;
    FaceAverages averages_;
    /// #F: the averaged normals, and memory for averages.
    FaceVectors normals_;
    FaceVectors means_;
};

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
std::vector<double> fractions_near_bounds(const Parts& parts, const Boxes& boxes, const CoordinateBounds& bounds,
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
void take(const Parts& parts, const std::vector<std::uint8_t>& taken, const Points& from, Points& positions,
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

/// See smooth_within.
/// @param bounds of vertices that do not move: 0.
SmoothedWithinSteps smooth_in_boxes(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                                    const KeptVolumes& volumes, const Points& positions, const CoordinateBounds& bounds,
                                    const Executor& exec)
{
    const Boxes boxes{positions, bounds.widths};
    SmoothedWithinSteps result{.positions = positions, .steps = bounds.steps};
    const double smallest_step = (bounds.steps.array() > 0.0).select(bounds.steps, bounds.steps.maxCoeff()).minCoeff();
    if (begins_with_fairing(bounds))
        result.fairing = fair_in_boxes(VertexAverages(mesh, topology, exec).neighbours(), boxes,
                                       {most_iterations, last_motion * smallest_step}, result.positions, exec);
    result.fairing.last_motion /= smallest_step;
    const Parts parts(mesh, topology, components);
    NormalsInBoxes normals(mesh, topology, parts, volumes, boxes, exec);
    const Points fair = result.positions;
    Points with_edges = fair;
    std::vector<double> bending = normals.smooth(all_normals, result.positions);
    const std::vector<double> bending_with_edges = normals.smooth(same_side, with_edges, bending);
    std::vector<std::uint8_t> taken(bending.size(), 0);
    for (std::size_t part = 0; part < bending.size(); ++part)
        if (!bends_no_less(bending_with_edges[part], bending[part])) {
            taken[part] = 1;
            bending[part] = bending_with_edges[part];
        }
    take(parts, taken, with_edges, result.positions, exec);
    uncross_faces(mesh, topology, fair, boxes, result.positions, exec);

    const std::vector<double> before = normals.bending(positions);
    const std::vector<double> near = fractions_near_bounds(parts, boxes, bounds, result.positions);
    const Evidence evidence = evidence_for(bounds.kind);
    std::vector<std::uint8_t> is_unexplained(bending.size(), 0);
    for (std::size_t part = 0; part < bending.size(); ++part) {
        const bool explains =
            before[part] > 0.0 && bending[part] / before[part] + evidence.of(near[part]) <= evidence.most;
        is_unexplained[part] = explains ? 0 : 1;
        result.explains_roughness = result.explains_roughness || explains;
    }
    result.where_explained = result.positions;
    take(parts, is_unexplained, positions, result.where_explained, exec);
    return result;
}

/// Smooths a surface whose components touch: copies of a vertex move as one.
SmoothedWithinSteps smooth_joined(const JoinedCopies& joined, KeptVolumes& volumes, const Points& positions,
                                  CoordinateBounds bounds, const Executor& exec)
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
    SmoothedWithinSteps result = smooth_in_boxes(joined.mesh, topology, face_components(joined.mesh, topology), volumes,
                                                 positions, bounds, exec);
    for (Points* const points : {&result.positions, &result.where_explained})
        for_each(exec, n, [&](Index v) { points->row(v) = points->row(original_of[v]); });
    return result;
}

}  // namespace

SmoothedWithinSteps smooth_within(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                  CoordinateBounds bounds, const std::vector<double>& strengths, const Executor& exec)
{
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double strength = strengths.empty() ? 1.0 : strengths[v];
        bounds.widths.row(v) *= topology.moves(v) ? strength : 0.0;
    });
    const Components components = face_components(mesh, topology);
    const std::optional<JoinedCopies> joined = join_copies(mesh, topology, components, positions, exec);
    KeptVolumes volumes(joined ? joined->all_faces : mesh, topology, components, positions, exec);
    if (joined)
        return smooth_joined(*joined, volumes, positions, std::move(bounds), exec);
    return smooth_in_boxes(mesh, topology, components, volumes, positions, bounds, exec);
}

CoordinateBounds bounds_of(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                           const Executor& exec)
{
    return bounds_of(positions, VertexAverages(mesh, topology, exec).neighbours(),
                     mean_edge_length(mesh, positions, exec), exec);
}

CoordinateBounds bounds_of(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                           const Point& steps, const Executor& exec)
{
    return bounds_of(positions, VertexAverages(mesh, topology, exec).neighbours(),
                     mean_edge_length(mesh, positions, exec), steps, exec);
}

std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const std::vector<double>& strengths,
                                                  const Executor& exec)
{
    const std::vector<Spike> spikes = find_spikes(mesh, positions, exec);
    const Points filled = spikes.empty() ? positions : without_spikes(mesh, topology, spikes, positions);
    CoordinateBounds bounds = bounds_of(mesh, topology, filled, exec);
    if (bounds.kind == CoordinateBounds::Kind::None)
        return std::nullopt;
    SmoothedWithinSteps smoothed = smooth_within(mesh, topology, filled, std::move(bounds), strengths, exec);
    if (!smoothed.explains_roughness)
        return std::nullopt;
    smoothed.positions = std::move(smoothed.where_explained);
    for (const Spike& spike : spikes)
        smoothed.positions.row(spike.vertex) = positions.row(spike.vertex);
    return smoothed;
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
