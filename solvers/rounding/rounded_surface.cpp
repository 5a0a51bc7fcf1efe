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
/// Rounding explains what is rough if at most this fraction of the bending is left, and at most this fraction of the
/// vertices is at its bounds. Digitised balls, tori, tubes, boxes and terrains have .04 to .49 and .00 to .15; regular
/// pyramids of blocks, studs and ribs .21 to .95 and .21 to .58.
constexpr double most_bending = 0.6;
constexpr double most_at_bounds = 0.175;
/// A vertex is at a bound if it has moved by this fraction of its width.
constexpr double at_bound = 0.98;
/// A fairing ends when no coordinate moves by more than this many steps in a turn.
constexpr double last_motion = 0.002;
constexpr int most_turns = 400;

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
        double bending = total_bending(mesh_, topology_, positions, exec_);
        for (int group = 0; group < n_groups; ++group) {
            Points further = positions;
            for (int i = 0; i < group_of_fits; ++i)
                smooth_once(sigma, further);
            const double bending_further = total_bending(mesh_, topology_, further, exec_);
            // The first group may bend a surface more that is to become one with edges.
            if (group > 0 && !(bending_further < bending))
                break;
            bending = bending_further;
            positions = std::move(further);
        }
        return bending;
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

/// The fraction of the vertices with bounds that are at one, in a direction in which the bounds are widest, in steps.
double fraction_at_bounds(const Boxes& boxes, const Point& steps, const Points& positions, const Executor& exec)
{
    Eigen::Array2d counts = sum(
        exec, static_cast<Index>(positions.rows()),
        [&](Index v) {
            const Point motion = (positions.row(v) - boxes.middles.row(v)).cwiseAbs();
            const Point width = boxes.widths.row(v);
            const Point in_steps = (steps.array() > 0.0).select(width.array() / steps.array(), 0.0);
            const bool has_bounds = in_steps.maxCoeff() > 0.0;
            const bool is_at_bound = has_bounds && (in_steps.array() >= at_bound * in_steps.maxCoeff() &&
                                                    motion.array() >= at_bound * width.array())
                                                       .any();
            return Eigen::Array2d(is_at_bound ? 1.0 : 0.0, has_bounds ? 1.0 : 0.0);
        },
        Eigen::Array2d(0.0, 0.0));
    return counts[1] > 0.0 ? counts[0] / counts[1] : 0.0;
}

bool begins_with_fairing(const CoordinateBounds& bounds)
{
    return bounds.kind != CoordinateBounds::Kind::MarchingCubes || !has_equal_steps(bounds.steps);
}

}  // namespace

double total_bending(const PolygonMesh& mesh, const Topology& topology, const Points& positions, const Executor& exec)
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
        Point normal = normal_of(h);
        Point other = normal_of(twin);
        // Half-edges in the same direction belong to faces with opposite orientations.
        if (mesh.face_vertices[usize(twin)] == v)
            other = -other;
        const double sine = Eigen::RowVector3d(normal.cross(other)).norm();
        return (positions.row(w) - positions.row(v)).norm() * std::atan2(sine, normal.dot(other));
    });
}

bool SmoothedWithinSteps::explains_roughness() const
{
    return bending <= most_bending && at_bounds <= most_at_bounds;
}

SmoothedWithinSteps smooth_within(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                  CoordinateBounds bounds, const std::vector<double>& strengths, const Executor& exec)
{
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double strength = strengths.empty() ? 1.0 : strengths[usize(v)];
        bounds.widths.row(v) *= topology.moves(v) ? strength : 0.0;
    });
    const Boxes boxes{positions, bounds.widths};
    SmoothedWithinSteps result{.positions = positions, .steps = bounds.steps};
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
    const double before = total_bending(mesh, topology, positions, exec);
    result.bending = before > 0.0 ? bending / before : 1.0;
    result.at_bounds = fraction_at_bounds(boxes, bounds.steps, result.positions, exec);
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
