#include "engine/steppers/vanishing_components.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/surface_components.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

// For a step, a small component is replaced by an enlarged copy of itself, its enlargement. A point (a component
// without digits of its shape) is replaced by a sphere. After the step the copy is brought back: scaled down about its
// centre.

/// dt over the squared diagonal of a component (that of its bounding box) above which the component is small. At this
/// value masses have eleven digits left beside dt K; and the scaling neglects the square of the shape that is left, a
/// relative error of 10⁻¹⁰.
constexpr double small_by_steps = 1e5;
/// A component whose diagonal is a smaller fraction of its coordinates than this is a point.
constexpr double point_in_coordinates = 1e6 * std::numeric_limits<double>::epsilon();

using Box = Eigen::AlignedBox3d;

Box box_of(const Points& positions, std::span<const Index> vertices)
{
    Box box;
    for (const Index v : vertices)
        box.extend(positions.row(v).transpose());
    return box;
}

/// The mean of vertices, computed relative to one of them: so no digits are lost far from the origin.
Point mean_of(const Points& positions, std::span<const Index> vertices)
{
    const Point origin = positions.row(vertices.front());
    Point sum = Point::Zero();
    for (const Index v : vertices)
        sum += positions.row(v) - origin;
    return origin + sum / static_cast<double>(vertices.size());
}

/// The i-th of n points that are spread evenly over a sphere of diameter 1, by turns of the golden ratio: a shape that
/// suits any faces.
Point spread_point(std::size_t i, std::size_t n)
{
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    return 0.5 * Point(radius * std::cos(angle), radius * std::sin(angle), height);
}

/// The strength of a vertex multiplies its time step, from 0 to 1. Steps with a smaller strength than this may leave
/// some of the shape of a small component.
constexpr double weak = 0.01;

void append(std::span<const Index> list, IndexLists& lists)
{
    lists.values.insert(lists.values.end(), list.begin(), list.end());
    lists.close();
}

/// Whether any face is so small that it can belong to a component smaller than `extent`.
bool has_small_face(const PolygonMesh& mesh, const Points& positions, double extent)
{
    std::atomic<bool> found = false;
    for_each_block(run_in_parallel, mesh.n_faces(), [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end && !found; ++f) {
            const auto corners = mesh.face(f);
            // One edge of each face is enough: no edge of a component is longer than its diagonal.
            if ((positions.row(corners[1]) - positions.row(corners[0])).squaredNorm() < extent * extent)
                found = true;
        }
    });
    return found;
}

/// Whether the bounding box of some vertices has a diagonal smaller than `extent`.
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

VanishingComponents::VanishingComponents(const PolygonMesh& mesh, const Topology& topology,
                                         const StepEquation& equation, bool is_implicit)
    : mesh_(mesh)
    , topology_(topology)
    , equation_(equation)
{
    const LaplacianTraits& traits = traits_of(equation.laplacian);
    // A Laplacian that divides by nothing does not depend on sizes.
    if (is_implicit && traits.divisor != Divisor::Nothing)
        extent_ = std::sqrt(equation.time_step / small_by_steps);
    // The matrix of a linear flow is that of the initial sizes in all steps, and keeps enough digits of its masses.
    if (equation.is_linear() && extent_ > 0.0)
        most_ = find_small(mesh.vertices, std::exchange(extent_, 0.0)).size();
    has_kept_lengths_ = equation.terms.keeps_stiffness && !equation.is_linear() && traits.mass_is_length;
    if (extent_ > 0.0 && (equation.terms.attaches() || has_kept_lengths_)) {
        initial_ = mesh.vertices;
        weights_.assign(equation.terms.weights.begin(), equation.terms.weights.end());
    }
}

/// The vertices of the components in which no vertex is fixed or has a strength below `weak`.
IndexLists VanishingComponents::free_components() const
{
    const auto is_fixed = [&](Index v) { return !topology_.moves(v) || equation_.terms.strength(v) < weak; };
    IndexLists free;
    const IndexLists all = surface_components(mesh_, run_in_parallel).vertices();
    for (Index c = 0; c < all.size(); ++c)
        if (std::ranges::none_of(all[c], is_fixed))
            append(all[c], free);
    return free;
}

/// The components whose bounding boxes have a diagonal smaller than `extent`: their vertices, ascending in each.
IndexLists VanishingComponents::find_small(const Points& positions, double extent)
{
    IndexLists small;
    if (!has_small_face(mesh_, positions, extent))
        return small;
    if (!free_)
        free_ = free_components();
    for (Index c = 0; c < free_->size(); ++c)
        if (is_smaller(positions, (*free_)[c], extent))
            append((*free_)[c], small);
    return small;
}

void VanishingComponents::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    if (initial_.rows() == 0)
        return;
    if (weights_.empty())
        weights_.assign(usize(mesh_.n_vertices()), equation_.terms.uniform_weight);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        weights_[vertices[i]] = weights[i];
}

void VanishingComponents::set_reference_vertices(std::span<const Index> vertices, const Points& to)
{
    // In a mean curvature flow, an attachment keeps its initial positions.
    if (initial_.rows() > 0 && equation_.terms.keeps_stiffness)
        move_rows(vertices, to, initial_);
}

void VanishingComponents::step(Stepper& stepper, const Points& before)
{
    const IndexLists small = extent_ > 0.0 ? find_small(before, extent_) : IndexLists();
    if (small.size() == 0)
        return stepper.step(before);
    most_ = std::max(most_, small.size());
    Points moved = before;
    std::vector<Enlargement> enlargements;
    for (Index c = 0; c < small.size(); ++c)
        enlargements.push_back(enlarge(small[c], moved));
    stepper.set_vertices(small.values, rows_of(moved, small.values));
    stepper.step(moved);
    moved = stepper.positions();
    for (Index c = 0; c < small.size(); ++c)
        bring_back(small[c], enlargements[c], before, moved);
    stepper.set_vertices(small.values, rows_of(moved, small.values));
}

/// Replaces a component by an enlarged copy, for which the step is computed.
/// @param positions #V by 3: the rows of the component are moved. @returns the map to the copy.
VanishingComponents::Enlargement VanishingComponents::enlarge(std::span<const Index> vertices, Points& positions) const
{
    const Box box = box_of(positions, vertices);
    const double diagonal = box.diagonal().norm();
    const double farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    // M scales with present lengths; K, if it is kept, with initial lengths.
    const double enlarged_diagonal =
        has_kept_lengths_ ? extent_ * (extent_ / box_of(initial_, vertices).diagonal().norm()) : extent_;
    Enlargement enlargement{.centre = mean_of(positions, vertices)};
    if (diagonal > point_in_coordinates * farthest) {
        enlargement.scale = std::max(enlarged_diagonal / diagonal, 1.0);
        // About M / (dt K) is left of a shape. M / K grows with the square of the scale, or with the scale alone if K
        // is kept; the shape itself grows with the scale.
        const double scale = enlargement.scale;
        enlargement.rest = 1.0 / (scale * scale * (has_kept_lengths_ ? 1.0 : scale));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Point shape = enlargement.scale > 0.0
                                ? Point(enlargement.scale * (positions.row(vertices[i]) - enlargement.centre))
                                : Point(enlarged_diagonal * spread_point(i, vertices.size()));
        positions.row(vertices[i]) = enlargement.centre + shape;
    }
    return enlargement;
}

/// The weight w of the attachment, with which vertex v is pulled to its initial position, multiplied by the strength.
double VanishingComponents::weight(Index v) const
{
    const FlowTerms& terms = equation_.terms;
    return (weights_.empty() ? terms.uniform_weight : weights_[v]) * terms.strength(v);
}

/// Scales a component down after the step, which was computed for its enlarged copy, and puts its centre where the step
/// moves the component itself.
/// @param before the positions before the step, not enlarged.
/// @param positions in: the result of the step for the enlarged copy; out: the result for the component.
void VanishingComponents::bring_back(std::span<const Index> vertices, const Enlargement& enlargement,
                                     const Points& before, Points& positions) const
{
    // The attachment: dt times the mean weight, and the weighted mean of the initial positions.
    double pull = 0.0;
    Point target = enlargement.centre;
    if (equation_.terms.attaches()) {
        double total = 0.0;
        Point towards = Point::Zero();
        for (const Index v : vertices) {
            total += weight(v);
            towards += weight(v) * (initial_.row(v) - enlargement.centre);
        }
        pull = equation_.time_step * total / static_cast<double>(vertices.size());
        if (total > 0.0)
            target += towards / total;
    }
    // The offset of the centre of mass from the mean of the vertices, which the step has computed in the scaled
    // component.
    const Point mean = mean_of(positions, vertices);
    Point off_centre = Point::Zero();
    if (enlargement.scale > 0.0)
        off_centre =
            ((mean - enlargement.centre) * (1.0 + pull) - pull * (target - enlargement.centre)) / enlargement.scale;
    const Point shift = (off_centre + pull * (target - enlargement.centre)) / (1.0 + pull);
    for (const Index v : vertices)
        positions.row(v) = enlargement.scale > 0.0
                               ? Point(enlargement.centre + shift + enlargement.rest * (positions.row(v) - mean))
                               : Point(before.row(v) + shift);
}

std::optional<Remark> VanishingComponents::remark() const
{
    if (most_ == 0)
        return {};
    return Remark("vanished", {{"components", most_}},
                  {fmt::format("{} so small compared with the amount that a point is left of {}: less smoothing keeps "
                               "{}, and the rest of the surface continued.",
                               most_ == 1 ? "1 component is" : fmt::format("{} components are", most_),
                               most_ == 1 ? "it" : "each", most_ == 1 ? "it" : "them")});
}

}  // namespace seamflow
