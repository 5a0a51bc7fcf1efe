#include "engine/steppers/vanishing_components.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/surface_components.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// dt over the squared diagonal of a component above which the component is small. At this value masses have eleven
/// digits left beside dt K, and a millionth is left of the shape.
constexpr double small_by_steps = 1e5;
/// Steps with a smaller strength may leave some of the shape of a small component.
constexpr double weak = 0.01;

/// The i-th of n points that are spread evenly over a sphere of diameter 1, by turns of the golden ratio: a shape that
/// suits any faces.
Point spread_point(std::size_t i, std::size_t n)
{
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    return 0.5 * Point(radius * std::cos(angle), radius * std::sin(angle), height);
}

double diagonal_of(const Points& positions, std::span<const Index> vertices)
{
    Eigen::AlignedBox3d box;
    for (const Index v : vertices)
        box.extend(positions.row(v).transpose());
    return box.diagonal().norm();
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
    if (equation.is_linear()) {
        find_small(mesh.vertices);
        extent_ = 0.0;
    }
    if (extent_ > 0.0 && equation.terms.attaches())
        initial_ = mesh.vertices;
}

void VanishingComponents::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    for (Index v = static_cast<Index>(weights_.size()); v < mesh_.n_vertices(); ++v)
        weights_.push_back(equation_.terms.weight(v));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        weights_[vertices[i]] = weights[i];
    equation_.terms.weights = weights_;
}

void VanishingComponents::set_reference_vertices(std::span<const Index> vertices, const Points& to)
{
    // In a mean curvature flow, an attachment keeps its initial positions.
    if (initial_.rows() > 0 && equation_.terms.keeps_stiffness)
        move_rows(vertices, to, initial_);
}

/// Whether a component is a point, or a step leaves only a point of it: no vertex is fixed or has a strength below
/// `weak`, and M + dt M w is far below dt K.
bool VanishingComponents::is_small(Index component, const Points& positions) const
{
    const std::span<const Index> vertices = vertices_[component];
    const double diagonal = diagonal_of(positions, vertices);
    double weight = 0.0;
    bool is_held = false;
    for (const Index v : vertices) {
        weight = std::max(weight, equation_.terms.weight(v));
        is_held = is_held || !topology_.moves(v) || equation_.terms.strength(v) < weak;
    }
    return diagonal == 0.0 || (!is_held && diagonal * std::sqrt(1.0 + equation_.time_step * weight) < extent_);
}

/// Finds the small components, and counts those that move.
std::vector<Index> VanishingComponents::find_small(const Points& positions)
{
    // One edge is enough: no edge of a component is longer than its diagonal.
    const auto is_small_face = [&](Index f) {
        const auto corners = mesh_.face(f);
        return (positions.row(corners[1]) - positions.row(corners[0])).squaredNorm() < extent_ * extent_;
    };
    std::vector<Index> small;
    if (extent_ == 0.0 || select(run_in_parallel, mesh_.n_faces(), is_small_face).empty())
        return small;
    if (faces_.size() == 0) {
        SurfaceComponents components = surface_components(mesh_, run_in_parallel);
        vertices_ = components.vertices();
        faces_ = std::move(components.faces);
    }
    for (Index c = 0; c < faces_.size(); ++c)
        if (is_small_face(faces_[c].front()) && is_small(c, positions))
            small.push_back(c);
    const auto moves = [&](Index v) { return topology_.moves(v); };
    const auto n_moving =
        std::ranges::count_if(small, [&](Index c) { return std::ranges::any_of(vertices_[c], moves); });
    most_ = std::max(most_, static_cast<Index>(n_moving));
    return small;
}

/// M at the vertices of a component; 1 if it is a point.
Eigen::ArrayXd VanishingComponents::masses(Index component, const Points& positions) const
{
    const std::span<const Index> vertices = vertices_[component];
    const bool by_lengths = traits_of(equation_.laplacian).mass_is_length;
    Eigen::ArrayX2d terms = Eigen::ArrayX2d::Zero(std::ssize(vertices), 2);
    const auto add = [&](Index v, double mass) {
        terms.row(std::ranges::lower_bound(vertices, v) - vertices.begin()) += Eigen::Array2d(mass, 1.0).transpose();
    };
    for (const Index f : faces_[component]) {
        const auto corners = mesh_.face(f);
        const double share = corner_area(area(corners, positions), corners.size());
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Index next = corners[k + 1 < corners.size() ? k + 1 : 0];
            const double length = (positions.row(next) - positions.row(corners[k])).norm();
            add(corners[k], by_lengths ? length : share);
            if (by_lengths)
                add(next, length);
        }
    }
    if (!std::isnormal(terms.col(0).sum()))
        return Eigen::ArrayXd::Ones(terms.rows());
    return by_lengths ? Eigen::ArrayXd(terms.col(0) / terms.col(1)) : Eigen::ArrayXd(terms.col(0));
}

/// The point to which a step takes a component: the sums of both sides of (M + dt K + dt M w) V = M Vᵏ + dt M w V⁰, to
/// which K adds nothing.
Point VanishingComponents::centroid(Index component, const Points& positions) const
{
    const std::span<const Index> vertices = vertices_[component];
    const Eigen::ArrayXd mass = masses(component, positions);
    const Point origin = positions.row(vertices.front());
    Point sum = Point::Zero();
    double total = 0.0;
    for (std::size_t i = 0; const Index v : vertices) {
        // A small component with a fixed vertex is a point.
        if (!topology_.moves(v) || equation_.terms.strength(v) == 0.0)
            return positions.row(v);
        const double of_vertex = mass[static_cast<Index>(i++)];
        const double here = of_vertex / equation_.terms.strength(v);
        const double pull = of_vertex * equation_.time_step * equation_.terms.weight(v);
        sum += here * (positions.row(v) - origin);
        if (pull > 0.0)
            sum += pull * (initial_.row(v) - origin);
        total += here + pull;
    }
    return origin + sum / total;
}

void VanishingComponents::step(Stepper& stepper, const Points& before)
{
    const std::vector<Index> small = find_small(before);
    if (small.empty())
        return stepper.step(before);
    // Faces need an area for the step. Where, and what it does to them, does not matter. Signs are those of the centre,
    // so that a mirrored mesh has the mirrored result, bit for bit.
    Points spread = before;
    Points after = before;
    std::vector<Index> vertices;
    for (const Index c : small) {
        const std::span<const Index> component = vertices_[c];
        const Point centre = centroid(c, before);
        const Point size = centre.unaryExpr([&](double x) { return std::copysign(extent_, x); });
        for (std::size_t i = 0; i < component.size(); ++i) {
            vertices.push_back(component[i]);
            spread.row(component[i]) = size.cwiseProduct(spread_point(i, component.size()));
            after.row(component[i]) = centre;
        }
    }
    stepper.set_vertices(vertices, rows_of(spread, vertices));
    stepper.step(spread);
    stepper.set_vertices(vertices, rows_of(after, vertices));
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
