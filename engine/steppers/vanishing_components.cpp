#include "engine/steppers/vanishing_components.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/connected_components.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// dt over the squared diagonal of a component from which on it is small: masses have eleven digits left beside dt K.
constexpr double small_by_steps = 1e5;

Eigen::AlignedBox3d box_of(const Points& positions, std::span<const Index> vertices)
{
    Eigen::AlignedBox3d box;
    for (const Index v : vertices)
        box.extend(positions.row(v).transpose());
    return box;
}

Point mean_of(const Points& positions, std::span<const Index> vertices)
{
    const Point origin = positions.row(vertices.front());
    Point sum = Point::Zero();
    for (const Index v : vertices)
        sum += positions.row(v) - origin;
    return origin + sum / static_cast<double>(vertices.size());
}

/// The i-th of n points spread over a ball of diameter 1: a shape that is no worse than others for any faces.
Point spread_point(std::size_t i, std::size_t n)
{
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    return 0.5 * Point(radius * std::cos(angle), radius * std::sin(angle), height);
}

bool is_point(const Points& positions, std::span<const Index> vertices)
{
    return std::ranges::all_of(vertices, [&](Index v) { return positions.row(v) == positions.row(vertices.front()); });
}

}  // namespace

VanishingComponents::VanishingComponents(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options)
    : mesh_(&mesh)
    , topology_(&topology)
    , options_(&options)
{
    // The Laplacian with uniform weights does not depend on any size.
    if (options.scheme != Scheme::BackwardEuler || smooths_normals(options) || options.laplacian == Laplacian::Uniform)
        return;
    extent_ = std::sqrt(options.time_step / small_by_steps);
    // The matrix of a linear flow has the sizes of the first surface in all steps, and keeps enough of its masses.
    if (options.flow == FlowEquation::Linear) {
        most_ = find_small(mesh.vertices).size();
        extent_ = 0.0;
    }
    // There M goes with lengths, and K, which is kept, with those of the first surface.
    if (options.flow == FlowEquation::Conformalized && traits_of(options.laplacian).divisor == Divisor::EdgeLengths) {
        find_components();
        for (Index c = 0; c < components_.count(); ++c)
            pose_.push_back(extent_ * (extent_ / std::max(box_of(mesh.vertices, components_.nodes[c]).diagonal().norm(),
                                                          1e-9 * extent_)));
    }
}

/// Whether any face is small enough for a small component.
bool VanishingComponents::has_small_face(const Points& positions) const
{
    std::atomic<bool> found = false;
    for_each_block(run_in_parallel, mesh_->n_faces(), [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end && !found; ++f) {
            const auto corners = mesh_->face(f);
            if ((positions.row(corners[1]) - positions.row(corners[0])).squaredNorm() < extent_ * extent_)
                found = true;
        }
    });
    return found;
}

bool VanishingComponents::is_small(const Points& positions, std::span<const Index> vertices) const
{
    Eigen::AlignedBox3d box;
    for (const Index v : vertices) {
        box.extend(positions.row(v).transpose());
        if (!(box.diagonal().norm() < extent_))
            return false;
    }
    return true;
}

void VanishingComponents::find_components()
{
    const IndexLists faces_at = make_lists(mesh_->n_vertices(), [&](auto&& add) {
        for (Index f = 0; f < mesh_->n_faces(); ++f)
            for (const Index v : mesh_->face(f))
                add(v, f);
    });
    components_ = connected_components(mesh_->n_vertices(), [&](Index v, auto&& visit) {
        for (const Index f : faces_at[v])
            for (const Index w : mesh_->face(f))
                visit(w);
    });
}

/// Where steps of a vertex are so weak that something of the shape may be left, its component counts as held.
bool VanishingComponents::is_free(std::span<const Index> vertices) const
{
    const std::vector<double>& strength = options_->motion.strength;
    return std::ranges::all_of(
        vertices, [&](Index v) { return topology_->moves(v) && (strength.empty() || strength[v] >= 0.01); });
}

/// The small components that nothing holds, and those that are points.
std::vector<Index> VanishingComponents::find_small(const Points& positions)
{
    std::vector<Index> small;
    if (extent_ == 0.0 || !has_small_face(positions))
        return small;
    if (components_.count() == 0)
        find_components();
    for (Index c = 0; c < components_.count(); ++c)
        if (const auto vertices = components_.nodes[c]; vertices.size() > 1 && is_small(positions, vertices) &&
                                                        (is_free(vertices) || is_point(positions, vertices)))
            small.push_back(c);
    return small;
}

void VanishingComponents::step(Stepper& stepper, const Points& before)
{
    const std::vector<Index> small = find_small(before);
    if (small.empty())
        return stepper.step(before);
    most_ = std::max(most_, small.size());
    std::vector<Index> vertices;
    std::vector<Point> posed;
    std::vector<Point> centres;
    for (const Index c : small) {
        const auto component = components_.nodes[c];
        const Point centre = mean_of(before, component);
        const double extent = pose_.empty() ? extent_ : pose_[c];
        for (std::size_t i = 0; i < component.size(); ++i) {
            vertices.push_back(component[i]);
            posed.emplace_back(centre + extent * spread_point(i, component.size()));
            centres.push_back(centre);
        }
    }
    const auto rows_of = [](const std::vector<Point>& points) {
        return Points(Eigen::Map<const Points>(points.front().data(), std::ssize(points), 3));
    };
    Points beginning = before;
    move_rows(vertices, rows_of(posed), beginning);
    stepper.move(vertices, rows_of(posed));
    stepper.step(beginning);
    stepper.move(vertices, rows_of(centres));
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
