#include "engine/steppers/vanishing_components.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/surface_components.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// dt over the squared diagonal of a component from which on it is small: masses have eleven digits left beside dt K,
/// and the scaling neglects the square of what is left of the shape, the ten-billionth part of it.
constexpr double small_by_steps = 1e5;
/// A component whose diagonal is a smaller fraction of its coordinates than this is a point.
constexpr double point_in_coordinates = 1e6 * std::numeric_limits<double>::epsilon();

using Box = Eigen::AlignedBox3d;

Box box_of(const Points& positions, std::span<const Index> rows)
{
    Box box;
    for (const Index row : rows)
        box.extend(positions.row(row).transpose());
    return box;
}

Point mean_of(const Points& positions, std::span<const Index> rows)
{
    const Point origin = positions.row(rows.front());
    Point sum = Point::Zero();
    for (const Index row : rows)
        sum += positions.row(row) - origin;
    return origin + sum / static_cast<double>(rows.size());
}

/// The i-th of n points spread over a ball of diameter 1: a shape that is no worse than others for any faces.
Point spread_point(std::size_t i, std::size_t n)
{
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    return 0.5 * Point(radius * std::cos(angle), radius * std::sin(angle), height);
}

/// Whether the steps of a vertex are so weak that something of the shape of a small component may be left.
/// @param strength #V, or empty: 1 everywhere.
bool is_weak(std::span<const double> strength, Index v)
{
    return !strength.empty() && strength[v] < 0.01;
}

/// Components of the vertices of faces, none of which is fixed or hardly moves.
IndexLists free_components(const PolygonMesh& mesh, const Topology& topology, std::span<const double> strength)
{
    const auto is_held = [&](Index v) { return !topology.moves(v) || is_weak(strength, v); };
    IndexLists free;
    const IndexLists all = surface_components(mesh, run_in_parallel).vertices();
    for (Index c = 0; c < all.size(); ++c) {
        if (std::ranges::any_of(all[c], is_held))
            continue;
        free.values.insert(free.values.end(), all[c].begin(), all[c].end());
        free.close();
    }
    return free;
}

/// Whether any face is small enough for a component of less than `extent`.
bool has_small_face(const PolygonMesh& mesh, const Points& positions, double extent)
{
    std::atomic<bool> found = false;
    for_each_block(run_in_parallel, mesh.n_faces(), [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end && !found; ++f) {
            const auto corners = mesh.face(f);
            if ((positions.row(corners[1]) - positions.row(corners[0])).squaredNorm() < extent * extent)
                found = true;
        }
    });
    return found;
}

/// Whether the bounding box of some vertices has a diagonal of less than `extent`.
bool is_smaller(const Points& positions, std::span<const Index> vertices, double extent)
{
    Box box;
    for (const Index v : vertices) {
        box.extend(positions.row(v).transpose());
        if (!(box.diagonal().norm() < extent))
            return false;
    }
    return true;
}

}  // namespace

FindSmallComponents find_small_components(const PolygonMesh& mesh, const Topology& topology,
                                          std::span<const double> strength)
{
    auto known = std::make_shared<std::optional<IndexLists>>();
    return [&mesh, &topology, strength, known](const Points& positions, double extent) {
        SmallComponents small;
        if (!has_small_face(mesh, positions, extent))
            return small;
        if (!*known)
            *known = free_components(mesh, topology, strength);
        for (Index c = 0; c < (*known)->size(); ++c) {
            const auto vertices = (**known)[c];
            if (!is_smaller(positions, vertices, extent))
                continue;
            for (const Index v : vertices) {
                small.rows.values.push_back(static_cast<Index>(small.vertices.size()));
                small.vertices.push_back(v);
            }
            small.rows.close();
        }
        small.table = [vertices = small.vertices](const Points& of_vertices) {
            return Points(of_vertices(vertices, Eigen::all));
        };
        return small;
    };
}

VanishingComponents::VanishingComponents(const FlowOptions& options, const Points& first, FindSmallComponents find)
    : options_(options)
    , find_(std::move(find))
{
    // The Laplacian with uniform weights does not depend on any size.
    if (options.scheme == Scheme::BackwardEuler && !smooths_normals(options) && options.laplacian != Laplacian::Uniform)
        extent_ = std::sqrt(options.time_step / small_by_steps);
    // The matrix of a linear flow has the sizes of the first surface in all steps, and keeps enough of its masses.
    if (options.flow == FlowEquation::Linear && extent_ > 0.0)
        most_ = find_(first, std::exchange(extent_, 0.0)).rows.size();
    is_attached_ = options.motion.attachment > 0.0 || !options.motion.attachment_weights.empty();
    has_kept_lengths_ =
        options.flow == FlowEquation::Conformalized && traits_of(options.laplacian).divisor == Divisor::EdgeLengths;
    if (extent_ > 0.0 && (is_attached_ || has_kept_lengths_))
        first_ = first;
}

void VanishingComponents::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    std::vector<double>& each = options_.motion.attachment_weights;
    if (first_.rows() == 0)
        return;
    if (each.empty())
        each.assign(usize(static_cast<Index>(first_.rows())), options_.motion.attachment);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        each[vertices[i]] = weights[i];
}

void VanishingComponents::set_reference_vertices(std::span<const Index> vertices, const Points& to)
{
    // Of a mean curvature flow an attachment goes on pulling to where it pulled.
    if (first_.rows() > 0 && options_.flow != FlowEquation::MeanCurvature)
        move_rows(vertices, to, first_);
}

void VanishingComponents::step(Stepper& stepper, const Points& before)
{
    const SmallComponents small = extent_ > 0.0 ? find_(before, extent_) : SmallComponents();
    const Index n = small.rows.size();
    if (n == 0)
        return stepper.step(before);
    most_ = std::max(most_, n);
    const Points table = small.table(before);
    const Points first = is_attached_ || has_kept_lengths_ ? small.table(first_) : Points(0, 3);
    Points posed = table;
    std::vector<Pose> poses;
    for (Index c = 0; c < n; ++c)
        poses.push_back(pose(small.rows[c], first, posed));
    Points beginning = before;
    for (std::size_t row = 0; row < small.vertices.size(); ++row)
        if (small.vertices[row] >= 0)
            beginning.row(small.vertices[row]) = posed.row(static_cast<Index>(row));
    stepper.set_vertices(small.vertices, posed);
    stepper.step(beginning);
    Points after = small.table(stepper.positions());
    Points weights;
    if (is_attached_) {
        const std::vector<double>& each = options_.motion.attachment_weights;
        Points of_vertices = Points::Constant(first_.rows(), 3, options_.motion.attachment);
        if (!each.empty())
            of_vertices.colwise() = Eigen::Map<const Eigen::VectorXd>(each.data(), first_.rows());
        const std::vector<double>& strength = options_.motion.strength;
        for (std::size_t v = 0; v < strength.size(); ++v)
            of_vertices.row(static_cast<Eigen::Index>(v)) *= strength[v];
        weights = small.table(of_vertices);
    }
    for (Index c = 0; c < n; ++c)
        bring_back(small.rows[c], poses[c], table, first, weights, after);
    stepper.set_vertices(small.vertices, after);
}

/// Brings a component to the pose for the step.
/// @param first the initial positions, if they are kept.
VanishingComponents::Pose VanishingComponents::pose(std::span<const Index> rows, const Points& first,
                                                    Points& table) const
{
    const Box box = box_of(table, rows);
    const double diagonal = box.diagonal().norm();
    const double farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    // M goes with lengths, and K, which is kept, with those of the first surface.
    const double wanted = has_kept_lengths_ ? extent_ * (extent_ / box_of(first, rows).diagonal().norm()) : extent_;
    Pose pose{.centre = mean_of(table, rows)};
    if (diagonal > point_in_coordinates * farthest) {
        pose.scale = std::max(wanted / diagonal, 1.0);
        pose.rest = 1.0 / (pose.scale * pose.scale * (has_kept_lengths_ ? 1.0 : pose.scale));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Point shape = pose.scale > 0.0 ? Point(pose.scale * (table.row(rows[i]) - pose.centre))
                                             : Point(wanted * spread_point(i, rows.size()));
        table.row(rows[i]) = pose.centre + shape;
    }
    return pose;
}

/// @param before as it was; first, weights those of the attachment, if there is one.
/// @param table as the step has left the component in its pose; receives where it is.
void VanishingComponents::bring_back(std::span<const Index> rows, const Pose& pose, const Points& before,
                                     const Points& first, const Points& weights, Points& table) const
{
    double pull = 0.0;
    Point target = pose.centre;
    if (is_attached_) {
        double total = 0.0;
        Point towards = Point::Zero();
        for (const Index row : rows) {
            total += weights(row, 0);
            towards += weights(row, 0) * (first.row(row) - pose.centre);
        }
        pull = options_.time_step * total / static_cast<double>(rows.size());
        if (total > 0.0)
            target += towards / total;
    }
    // The offset of the centroid by mass from the mean of the vertices: the step has found it, scaled.
    const Point mean = mean_of(table, rows);
    Point off_centre = Point::Zero();
    if (pose.scale > 0.0)
        off_centre = ((mean - pose.centre) * (1.0 + pull) - pull * (target - pose.centre)) / pose.scale;
    const Point shift = (off_centre + pull * (target - pose.centre)) / (1.0 + pull);
    for (const Index row : rows)
        table.row(row) = pose.scale > 0.0 ? Point(pose.centre + shift + pose.rest * (table.row(row) - mean))
                                          : Point(before.row(row) + shift);
}

std::string VanishingComponents::remark() const
{
    if (most_ == 0)
        return {};
    return fmt::format("{} so small compared with the amount that a point is left of {}: less smoothing keeps {}, and "
                       "the rest of the surface continued.",
                       most_ == 1 ? "1 component is" : fmt::format("{} components are", most_),
                       most_ == 1 ? "it" : "each", most_ == 1 ? "it" : "them");
}

}  // namespace seamflow
