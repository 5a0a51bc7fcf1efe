#include "solvers/rounding/rounded_surface.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/kept_volumes.h"

namespace seamflow {

namespace {

/// The chords of unit normals over which normals are averaged: between all neighbours, and on one side of an edge.
constexpr float all_normals = 1.5F;
constexpr float same_side = 0.3F;
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
};

/// In brackets the sums of digitised shapes (balls, tori, tubes, boxes, plates, egg crates, terrains), then those of
/// shapes of blocks (pyramids of steps, studs, ribs, pockets, letters), which are to stay.
Evidence evidence_for(CoordinateBounds::Kind kind)
{
    switch (kind) {
    case CoordinateBounds::Kind::Heights:
        // [.21 to .87; 1.08 to 3.0; stairs of equal treads, which a ramp becomes, too, .12 to .53]
        return {.near = 0.9, .weight = 3.0, .most = 1.0};
    case CoordinateBounds::Kind::MarchingCubes:
        // [.18 to .66, two slices of plates and crates above; .67 to 1.4, stairs of one or two voxels .39 to .63]
        return {.near = 0.98, .weight = 2.0, .most = 0.66};
    default:
        // [.14 to .465; .475 to 1.1]
        return {.near = 0.98, .weight = 1.0, .most = 0.47};
    }
}

/// A fairing ends when no coordinate moves by more than this many steps in a turn.
constexpr double last_motion = 0.002;
constexpr int most_turns = 400;

/// The total bending of a surface: Σ l θ over its edges of two faces, with the length l and the angle θ between the
/// normals of the faces. It is the same for a convex body and its rounded copies, however sharp its edges are, and
/// grows with every wave: what stairs add to it disappears with them. Edges between vertices without bounds do not
/// count.
double total_bending(const PolygonMesh& mesh, const Topology& topology, const Points& widths, const Points& positions,
                     const Executor& exec)
{
    const auto normal_of = [&](Index h) -> Point {
        return vector_area(mesh.face(topology.face_of[usize(h)]), positions);
    };
    return sum(exec, mesh.n_corners(), [&](Index h) {
        const Index twin = topology.twin[usize(h)];
        if (twin < h)
            return 0.0;
        const Index v = mesh.face_vertices[usize(h)];
        const Index w = mesh.face_vertices[usize(topology.next(mesh, h))];
        if (widths.row(v).isZero(0.0) && widths.row(w).isZero(0.0))
            return 0.0;
        const Point normal = normal_of(h);
        Point other = normal_of(twin);
        // Half-edges in the same direction belong to faces with opposite orientations.
        if (mesh.face_vertices[usize(twin)] == v)
            other = -other;
        const double sine = Eigen::RowVector3d(normal.cross(other)).norm();
        return (positions.row(w) - positions.row(v)).norm() * std::atan2(sine, normal.dot(other));
    });
}

/// Smooths the normals of a surface within bounds.
class NormalsInBoxes {
  public:
    NormalsInBoxes(const PolygonMesh& mesh, const Topology& topology, const Boxes& boxes, const Executor& exec)
        : mesh_(mesh)
        , topology_(topology)
        , boxes_(boxes)
        , exec_(exec)
        , averages_(mesh, topology, exec)
        , volumes_(mesh, topology, boxes.middles, exec)
    {
    }

    /// Averages normals over chords of `sigma` and fits the vertices to them, several times.
    /// @returns the total bending of the result.
    double smooth(float sigma, Points& positions)
    {
        double least = bending(positions);
        for (int group = 0; group < n_groups; ++group) {
            Points further = positions;
            for (int i = 0; i < group_of_fits; ++i)
                smooth_once(sigma, further);
            const double bending_further = bending(further);
            // The first group may bend a surface more that is to become one with edges.
            if (group > 0 && !(bending_further < least))
                break;
            least = bending_further;
            positions = std::move(further);
        }
        return least;
    }

    [[nodiscard]] double bending(const Points& positions) const
    {
        return total_bending(mesh_, topology_, boxes_.widths, positions, exec_);
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
    const Boxes& boxes_;
    const Executor& exec_;
    FaceAverages averages_;
    KeptVolumes volumes_;
    /// #F: the averaged normals, and memory for averages.
    FaceVectors normals_;
    FaceVectors means_;
};

/// The fraction of the vertices with bounds that have moved by at least the fraction `near` of their width, in a
/// direction in which bounds are widest, in steps.
double fraction_near_bounds(const Boxes& boxes, const Point& steps, double near, const Points& positions,
                            const Executor& exec)
{
    Eigen::Array2d counts = sum(
        exec, static_cast<Index>(positions.rows()),
        [&](Index v) {
            const Point motion = (positions.row(v) - boxes.middles.row(v)).cwiseAbs();
            const Point width = boxes.widths.row(v);
            const Point in_steps = (steps.array() > 0.0).select(width.array() / steps.array(), 0.0);
            const bool has_bounds = in_steps.maxCoeff() > 0.0;
            const bool is_near =
                has_bounds &&
                (in_steps.array() >= near * in_steps.maxCoeff() && motion.array() >= near * width.array()).any();
            return Eigen::Array2d(is_near ? 1.0 : 0.0, has_bounds ? 1.0 : 0.0);
        },
        Eigen::Array2d(0.0, 0.0));
    return counts[1] > 0.0 ? counts[0] / counts[1] : 0.0;
}

bool begins_with_fairing(const CoordinateBounds& bounds)
{
    return bounds.kind != CoordinateBounds::Kind::MarchingCubes || !has_equal_steps(bounds.steps);
}

}  // namespace

bool SmoothedWithinSteps::explains_roughness() const
{
    const Evidence evidence = evidence_for(kind);
    return bending + evidence.weight * near_bounds <= evidence.most;
}

SmoothedWithinSteps smooth_within(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                  CoordinateBounds bounds, const std::vector<double>& strengths, const Executor& exec)
{
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double strength = strengths.empty() ? 1.0 : strengths[usize(v)];
        bounds.widths.row(v) *= topology.moves(v) ? strength : 0.0;
    });
    const Boxes boxes{positions, bounds.widths};
    SmoothedWithinSteps result{.positions = positions, .kind = bounds.kind, .steps = bounds.steps};
    if (begins_with_fairing(bounds))
        result.fairing = fair_in_boxes(VertexAverages(mesh, topology, exec).neighbours(), boxes,
                                       {most_turns, last_motion * bounds.steps.maxCoeff()}, result.positions, exec);
    NormalsInBoxes normals(mesh, topology, boxes, exec);
    Points with_edges = result.positions;
    double bending = normals.smooth(all_normals, result.positions);
    const double bending_with_edges = normals.smooth(same_side, with_edges);
    if (bending_with_edges < bends_less * bending) {
        bending = bending_with_edges;
        result.positions = std::move(with_edges);
    }
    const double before = normals.bending(positions);
    result.bending = before > 0.0 ? bending / before : 1.0;
    result.near_bounds =
        fraction_near_bounds(boxes, bounds.steps, evidence_for(bounds.kind).near, result.positions, exec);
    return result;
}

std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const std::vector<double>& strengths,
                                                  const Executor& exec)
{
    const double length = mean_edge_length(mesh, positions, exec);
    CoordinateBounds bounds = bounds_of(positions, find_coordinate_steps(positions, length, exec), length, exec);
    if (bounds.kind == CoordinateBounds::Kind::None)
        return std::nullopt;
    SmoothedWithinSteps smoothed = smooth_within(mesh, topology, positions, std::move(bounds), strengths, exec);
    if (!smoothed.explains_roughness())
        return std::nullopt;
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
