#include "partition/metrics/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "partition/index_lists.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

namespace {

constexpr Index most_neighbourhoods = 500;
/// With fewer, noise cannot be distinguished from shape.
constexpr Index fewest_neighbourhoods = 200;
/// The vertices of a neighbourhood are those within this many rings of its middle, and at most this many of them.
constexpr int member_rings = 2;
constexpr std::size_t most_members = 24;
/// A half with fewer vertices gives no information.
constexpr int fewest_of_half = 3;
constexpr int near_rings = 2;
constexpr int wide_rings = 3;
/// Around vertices of hundreds of faces, rings are not meaningful.
constexpr std::size_t most_surrounding = 1000;
/// A quadratic function of two coordinates has six coefficients; with hardly more points it fits their noise.
constexpr std::size_t fewest_points = 9;
/// Pivots smaller than this, relative to the largest, are those of points on a conic section.
constexpr double smallest_pivot = 1e-10;

/// The following is calibrated on known surfaces and on files of parts, scans and models, with and without noise. The
/// fraction of the neighbourhoods that counts.
constexpr double smoothest = 0.12;
/// Squared residuals on three rings over those on two: for noise in the smoothest neighbourhoods, and for shape.
constexpr double growth_of_noise = 1.06;
constexpr double growth_of_shape = 2.05;
/// The true deviation over that of smooth neighbourhoods, in which noise is a little smaller than elsewhere.
constexpr double smaller_than_elsewhere = 1.04;
/// The correlation of residuals of neighbours over that of independent noise, which is negative: for noise in smooth
/// neighbourhoods it is 0.3 to 0.8, for shape it is mostly below 0.
constexpr double least_whiteness = 0.2;
/// Few vertices with noise are within this fraction of its deviation from their fits: more than this fraction of all
/// are on planes or the like, where noise would have moved them.
constexpr double quiet = 0.02;
constexpr double most_quiet = 0.06;
/// In measured mean edges: noise of half of the true mean edge makes edges half as long again.
constexpr double most_noise = 1.0 / 3.0;
constexpr double least_noise = 1e-2;

/// The sums of squared residuals over some vertices, for fits to two and to three rings.
struct Residuals {
    double near = 0.0;
    double wide = 0.0;
    int count = 0;

    void operator+=(const Residuals& other)
    {
        near += other.near;
        wide += other.wide;
        count += other.count;
    }
};

/// The sums over pairs of neighbours of the products of their residuals, and of their expected values if there is only
/// independent noise of variance 1.
struct Products {
    double found = 0.0;
    double expected = 0.0;

    void operator+=(const Products& other)
    {
        found += other.found;
        expected += other.expected;
    }
};

struct Neighbourhood {
    /// Every other vertex, and the rest.
    std::array<Residuals, 2> halves;
    Products products;
    /// Absolute values for all vertices, from fits to two rings.
    std::vector<double> residuals;
};

/// The fits at a vertex. Residuals are linear in the heights of the vertices around; for independent noise of variance
/// 1 they have variance 1.
struct VertexFit {
    /// The residual of the fit to two rings, along the direction.
    double near = 0.0;
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    /// The local numbers of the vertices of two rings and the vertex, and the weights of their heights in the residual.
    std::vector<Index> vertices;
    std::vector<double> weights;
    /// Of the fit to three rings.
    double squared_wide = 0.0;
};

/// The vertices around a vertex, in ascending order, and the neighbours of those further inside: the vertices of their
/// faces.
class Surroundings {
  public:
    Surroundings(const PolygonMesh& mesh, const Topology& topology, Index middle)
    {
        constexpr int n_rings = member_rings + wide_rings;
        std::vector<std::pair<Index, std::vector<Index>>> fans;
        vertices_ = {middle};
        std::vector<Index> front = vertices_;
        for (int ring = 0; ring < n_rings && is_small(); ++ring) {
            if (ring == member_rings)
                members_ = vertices_;
            std::vector<Index> reached;
            for (const Index v : front) {
                fans.emplace_back(v, vertices_of_faces_at(mesh, topology, v));
                reached.insert(reached.end(), fans.back().second.begin(), fans.back().second.end());
            }
            sort_unique(reached);
            front.clear();
            std::ranges::set_difference(reached, vertices_, std::back_inserter(front));
            vertices_.insert(vertices_.end(), front.begin(), front.end());
            std::ranges::sort(vertices_);
        }
        neighbours_.resize(vertices_.size());
        for (auto& [v, fan] : fans) {
            for (Index& w : fan)
                w = local(w);
            neighbours_[local(v)] = std::move(fan);
        }
        thin_out(members_);
    }

    [[nodiscard]] bool is_small() const { return vertices_.size() <= most_surrounding; }
    [[nodiscard]] const std::vector<Index>& members() const { return members_; }
    [[nodiscard]] Index size() const { return static_cast<Index>(vertices_.size()); }
    [[nodiscard]] Index vertex(Index i) const { return vertices_[i]; }

    [[nodiscard]] Index local(Index v) const { return place_in(vertices_, v); }

    [[nodiscard]] bool are_neighbours(Index v, Index w) const { return std::ranges::binary_search(neighbours_[v], w); }

    /// The local numbers of the vertices within some rings of v, without v, by rings; and where each ring ends.
    void rings_around(Index v, std::vector<Index>& rings, std::array<std::size_t, wide_rings>& ends) const
    {
        std::vector<std::uint8_t> reached(vertices_.size(), 0);
        rings = {local(v)};
        reached[rings.front()] = 1;
        std::size_t begin = 0;
        for (std::size_t& end : ends) {
            for (const std::size_t last = rings.size(); begin < last; ++begin)
                for (const Index w : neighbours_[rings[begin]])
                    if (std::exchange(reached[w], std::uint8_t{1}) == 0)
                        rings.push_back(w);
            end = rings.size() - 1;
        }
        rings.erase(rings.begin());
    }

  private:
    static std::vector<Index> vertices_of_faces_at(const PolygonMesh& mesh, const Topology& topology, Index v)
    {
        std::vector<Index> found;
        for (const Index corner : topology.corners_at(v)) {
            const auto face = mesh.face(topology.face_of[corner]);
            found.insert(found.end(), face.begin(), face.end());
        }
        sort_unique(found);
        return found;
    }

    static void thin_out(std::vector<Index>& members)
    {
        const std::size_t n = members.size();
        for (std::size_t i = 0; i < most_members && n > most_members; ++i)
            members[i] = members[i * n / most_members];
        members.resize(std::min(n, most_members));
    }

    std::vector<Index> vertices_;
    std::vector<Index> members_;
    std::vector<std::vector<Index>> neighbours_;
};

/// The height of the origin over the quadratic height function fitted to points around it, whose heights are their
/// first coordinates.
struct HeightFit {
    /// Divided by the deviation that it has if the points and the origin have deviation 1.
    double residual = 0.0;
    /// Of the points' heights in the residual, and of the origin's.
    std::vector<double> weights;
};

std::optional<HeightFit> fit_heights(const Eigen::Ref<const Eigen::MatrixX3d>& points)
{
    using Coefficients = Eigen::Matrix<double, 6, 1>;
    const auto functions = [&](Eigen::Index i) {
        const double x = points(i, 1);
        const double y = points(i, 2);
        return Coefficients(1.0, x, y, x * x, x * y, y * y);
    };
    Eigen::Matrix<double, 6, 6> squared = Eigen::Matrix<double, 6, 6>::Zero();
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        squared.noalias() += functions(i) * functions(i).transpose();
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> factor(squared);
    const auto pivots = factor.vectorD();
    if (!(pivots.minCoeff() > smallest_pivot * pivots.maxCoeff()))
        return {};
    const Coefficients of_origin = factor.solve(Coefficients::Unit(0));
    const double deviation = std::sqrt(1.0 + std::max(of_origin[0], 0.0));
    HeightFit fit;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        fit.weights.push_back(-of_origin.dot(functions(i)) / deviation);
        fit.residual += fit.weights.back() * points(i, 0);
    }
    fit.weights.push_back(1.0 / deviation);
    return std::isfinite(fit.residual) ? std::optional(std::move(fit)) : std::nullopt;
}

/// @param points around the origin, n by 3. @param n_near the number of those of two rings, which come first.
std::optional<VertexFit> fit_rings(Eigen::MatrixX3d& points, std::size_t n_near)
{
    const auto near = points.topRows(static_cast<Eigen::Index>(n_near));
    const Eigen::RowVector3d centre = near.colwise().mean();
    const Eigen::MatrixX3d centred = near.rowwise() - centre;
    const double size = std::sqrt(centred.squaredNorm() / static_cast<double>(n_near));
    if (!std::isnormal(size))
        return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred.transpose() * centred / (size * size));
    points = points * axes.eigenvectors() / size;
    std::optional<HeightFit> of_near = fit_heights(points.topRows(static_cast<Eigen::Index>(n_near)));
    const std::optional<HeightFit> of_wide = fit_heights(points);
    if (!of_near || !of_wide)
        return {};
    VertexFit fit;
    fit.near = size * of_near->residual;
    fit.direction = axes.eigenvectors().col(0);
    fit.weights = std::move(of_near->weights);
    fit.squared_wide = size * size * of_wide->residual * of_wide->residual;
    return fit;
}

std::optional<VertexFit> fit_at(const PolygonMesh& mesh, const Surroundings& surroundings, Index v)
{
    std::vector<Index> rings;
    std::array<std::size_t, wide_rings> ends{};
    surroundings.rings_around(v, rings, ends);
    const std::size_t n_near = ends[near_rings - 1];
    if (n_near < fewest_points)
        return {};
    Eigen::MatrixX3d points(static_cast<Eigen::Index>(rings.size()), 3);
    for (std::size_t i = 0; i < rings.size(); ++i)
        points.row(static_cast<Eigen::Index>(i)) =
            mesh.vertices.row(surroundings.vertex(rings[i])) - mesh.vertices.row(v);
    std::optional<VertexFit> fit = fit_rings(points, n_near);
    if (fit) {
        rings.resize(n_near);
        rings.push_back(surroundings.local(v));
        fit->vertices = std::move(rings);
    }
    return fit;
}

/// Over all pairs of neighbours among the fitted vertices.
Products products_of(const std::vector<VertexFit>& fits, const Surroundings& surroundings)
{
    Products products;
    std::vector<double> weights(at(surroundings.size()), 0.0);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        for (std::size_t k = 0; k < fits[i].vertices.size(); ++k)
            weights[fits[i].vertices[k]] = fits[i].weights[k];
        for (std::size_t j = 0; j < i; ++j) {
            if (!surroundings.are_neighbours(fits[i].vertices.back(), fits[j].vertices.back()))
                continue;
            double correlation = 0.0;
            for (std::size_t k = 0; k < fits[j].vertices.size(); ++k)
                correlation += fits[j].weights[k] * weights[fits[j].vertices[k]];
            const double sense = fits[i].direction.dot(fits[j].direction) < 0.0 ? -1.0 : 1.0;
            products += {sense * fits[i].near * fits[j].near, correlation};
        }
        for (const Index v : fits[i].vertices)
            weights[v] = 0.0;
    }
    return products;
}

Neighbourhood measure_neighbourhood(const PolygonMesh& mesh, const Topology& topology, Index middle)
{
    Neighbourhood found;
    const Surroundings surroundings(mesh, topology, middle);
    if (!surroundings.is_small())
        return found;
    std::vector<VertexFit> fits;
    for (const Index v : surroundings.members())
        if (topology.kind[v] == VertexKind::Interior)
            if (std::optional<VertexFit> fit = fit_at(mesh, surroundings, v)) {
                found.halves[fits.size() % 2] += {fit->near * fit->near, fit->squared_wide, 1};
                found.residuals.push_back(std::abs(fit->near));
                fits.push_back(std::move(*fit));
            }
    found.products = products_of(fits, surroundings);
    return found;
}

/// The fraction of all vertices that noise of that deviation has not moved.
double quiet_part(const std::vector<Neighbourhood>& neighbourhoods, double noise)
{
    std::size_t n = 0;
    std::ptrdiff_t n_quiet = 0;
    for (const Neighbourhood& found : neighbourhoods) {
        n += found.residuals.size();
        n_quiet += std::ranges::count_if(found.residuals, [&](double r) { return r < quiet * noise; });
    }
    return static_cast<double>(n_quiet) / static_cast<double>(n);
}

/// The sums over the smoothest neighbourhoods.
struct Evidence {
    Residuals residuals;
    Products products;

    /// Adds the other halves of the neighbourhoods whose given half, the first or the second, has the smallest
    /// residuals.
    void add_smoothest(const std::vector<Neighbourhood>& neighbourhoods, std::size_t half)
    {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
            const Residuals& chosen_by = neighbourhoods[i].halves[half];
            order.emplace_back(chosen_by.wide / chosen_by.count, i);
        }
        const auto n = static_cast<std::size_t>(std::ceil(smoothest * static_cast<double>(order.size())));
        std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(n));
        for (std::size_t i = 0; i < n; ++i) {
            residuals += neighbourhoods[order[i].second].halves[1 - half];
            products += neighbourhoods[order[i].second].products;
        }
    }

    [[nodiscard]] bool is_white() const
    {
        return products.found <= least_whiteness * products.expected * residuals.near / residuals.count;
    }

    /// The deviation of the noise.
    [[nodiscard]] double noise() const
    {
        if (!(residuals.near > 0.0) || !is_white())
            return 0.0;
        const double growth = std::max(residuals.wide / residuals.near / growth_of_noise, 1.0);
        const double part_of_noise = std::max((growth_of_shape - growth) / (growth_of_shape - 1.0), 0.0);
        return smaller_than_elsewhere * std::sqrt(part_of_noise * residuals.near / residuals.count);
    }
};

}  // namespace

double estimate_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const Index n = mesh.n_vertices();
    const Index n_middles = std::min(n, most_neighbourhoods);
    std::vector<Neighbourhood> neighbourhoods(at(n_middles));
    for_each(exec, n_middles, [&](Index i) {
        const Index middle = middle_of_part(i, n_middles, n);
        if (topology.kind[middle] == VertexKind::Interior)
            neighbourhoods[i] = measure_neighbourhood(mesh, topology, middle);
    });
    std::erase_if(neighbourhoods, [](const Neighbourhood& found) {
        return found.halves[0].count < fewest_of_half || found.halves[1].count < fewest_of_half;
    });
    if (neighbourhoods.size() < at(fewest_neighbourhoods))
        return 0.0;
    Evidence evidence;
    evidence.add_smoothest(neighbourhoods, 0);
    evidence.add_smoothest(neighbourhoods, 1);
    const double noise = evidence.noise();
    const double edge = mean_edge_length(mesh, mesh.vertices, exec);
    const bool is_believed = noise >= least_noise * edge && noise <= most_noise * edge;
    return is_believed && quiet_part(neighbourhoods, noise) <= most_quiet ? noise : 0.0;
}

}  // namespace seamflow
