#include "solvers/denoising/rim_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "partition/index_lists.h"
#include "partition/vector_area.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The turn of a curve within R, in radians, at which half of the weight of a bend is left.
constexpr double turn_at_corners = 0.6;
/// The number of rounds in which corners are found.
constexpr int rounds_for_corners = 6;
/// Edges shorter than this fraction of the mean length count as this long: noise that folds a curve leaves edges of
/// length 0.
constexpr double shortest_edge = 0.25;
/// The width of a band, as a multiple of the largest motion: faces are squeezed by a quarter at most.
constexpr double widths_of_band = 4.0;
/// The fraction of its area that each face is to keep; the factor by which motions are shortened at a time, and how
/// often at most.
constexpr double least_area = 0.1;
constexpr double shortening = 0.9;
constexpr int most_shortenings = 40;

/// An edge of one face between boundary vertices, in its direction there.
struct Segment {
    std::array<Index, 2> ends;
    Index face;
};

/// Symmetric positive definite equations in which an unknown of a curve is coupled with the next two unknowns on both
/// sides. The unknowns of a closed curve are numbered from both of its ends in turn, so that numbers of coupled
/// unknowns differ by at most four: the factors L D Lᵀ have the same band.
class BandedEquations {
  public:
    BandedEquations(Index n, bool is_closed)
        : band_(Band::Zero(n, width + 1))
        , is_closed_(is_closed)
    {
    }

    /// Adds to a coefficient of the symmetric matrix. For different unknowns, (i, j) and (j, i) are both added by the
    /// caller, and only the pair with i < j counts.
    void add(Index i, Index j, double value)
    {
        const Index row = std::max(number(i), number(j));
        const Index column = std::min(number(i), number(j));
        if (i == j)
            band_(row, 0) += value;
        else if (row > column)
            band_(row, row - column) += i < j ? value : 0.0;
    }

    /// Factorises the matrix in place and solves the equations, once.
    /// @param right_hand_side n by 3, in the order of the curve. @returns n by 3, in the same order.
    Points solve(const Points& right_hand_side)
    {
        const auto n = static_cast<Index>(band_.rows());
        Points x(n, 3);
        for (Index i = 0; i < n; ++i)
            x.row(number(i)) = right_hand_side.row(i);
        for (Index i = 0; i < n; ++i) {
            // l_ij d_j = a_ij - Σ l_ik d_k l_jk
            for (Index j = std::max(Index{0}, i - width); j <= i; ++j) {
                double value = band_(i, i - j);
                for (Index k = std::max(Index{0}, i - width); k < j; ++k)
                    value -= band_(i, i - k) * band_(k, 0) * band_(j, j - k);
                band_(i, i - j) = j < i ? value / band_(j, 0) : value;
            }
            for (Index k = std::max(Index{0}, i - width); k < i; ++k)
                x.row(i) -= band_(i, i - k) * x.row(k);
        }
        for (Index i = n - 1; i >= 0; --i) {
            x.row(i) /= band_(i, 0);
            for (Index k = i + 1; k <= std::min(n - 1, i + width); ++k)
                x.row(i) -= band_(k, k - i) * x.row(k);
        }
        Points solution(n, 3);
        for (Index i = 0; i < n; ++i)
            solution.row(i) = x.row(number(i));
        return solution;
    }

  private:
    static constexpr Index width = 4;
    using Band = Eigen::Matrix<double, Eigen::Dynamic, width + 1, Eigen::RowMajor>;

    /// The number of the i-th unknown of the curve in the matrix.
    [[nodiscard]] Index number(Index i) const
    {
        const auto n = static_cast<Index>(band_.rows());
        if (!is_closed_)
            return i;
        return 2 * i < n ? 2 * i : 2 * (n - i) - 1;
    }

    /// Row i has the entries (i, i), (i, i - 1) and so on.
    Band band_;
    bool is_closed_;
};

/// One normal per vertex of a curve: the sum of the normals of its faces at the curve, which need not be oriented
/// alike; if these have none, the sum of the normals at the neighbouring vertices of the curve.
Points normals_along(const RimCurve& curve, const Points& normals)
{
    Points sums = Points::Zero(static_cast<Eigen::Index>(curve.vertices.size()), 3);
    for (std::size_t s = 0; s < curve.faces.size(); ++s) {
        const std::size_t after = s + 1 < curve.vertices.size() ? s + 1 : 0;
        for (const std::size_t end : {s, after})
            sums.row(static_cast<Eigen::Index>(end)) += curve.senses[s] * normals.row(curve.faces[s]);
    }
    const Points of_faces = sums;
    const auto n = static_cast<Eigen::Index>(curve.vertices.size());
    for (Eigen::Index i = 0; i < n; ++i)
        if (of_faces.row(i).isZero(0.0))
            for (const Eigen::Index beside : {i - 1, i + 1})
                if (curve.is_closed || (beside >= 0 && beside < n))
                    sums.row(i) += of_faces.row((beside + n) % n);
    return sums;
}

/// The edges of one face between vertices of kind Boundary.
std::vector<Segment> segments_of(const PolygonMesh& mesh, const Topology& topology)
{
    std::vector<Segment> segments;
    const auto is_rim = [&](Index v) { return topology.kind[v] == VertexKind::Boundary; };
    for (Index h = 0; h < mesh.n_corners(); ++h)
        if (topology.twin[h] < 0) {
            const Index from = mesh.face_vertices[h];
            const Index to = mesh.face_vertices[topology.next(mesh, h)];
            if (is_rim(from) && is_rim(to))
                segments.push_back({{from, to}, topology.face_of[h]});
        }
    return segments;
}

/// Calls visit(w) at the other end of each edge of each face at a vertex.
template <class Visit>
void visit_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v, Visit&& visit)
{
    for (const Index corner : topology.corners_at(v))
        for (const Index end : {topology.next(mesh, corner), topology.previous(mesh, corner)})
            visit(mesh.face_vertices[end]);
}

/// #V: the number of rings of vertices that follow a curve, at the vertices of the curve: enough for the curve's
/// largest motion, given its edges.
std::vector<Index> rings_of_bands(const PolygonMesh& mesh, const Topology& topology, std::span<const RimCurve> curves,
                                  const Points& positions, const Points& motions)
{
    std::vector<Index> n_rings(usize(mesh.n_vertices()), 0);
    for (const RimCurve& curve : curves) {
        double largest = 0.0;
        double total = 0.0;
        double n_edges = 0.0;
        for (const Index v : curve.vertices) {
            if (motions.row(v).isZero(0.0))
                continue;
            largest = std::max(largest, motions.row(v).norm());
            visit_neighbours(mesh, topology, v, [&](Index w) {
                total += (positions.row(w) - positions.row(v)).norm();
                n_edges += 1.0;
            });
        }
        if (total > 0.0)
            for (const Index v : curve.vertices)
                n_rings[v] = static_cast<Index>(std::ceil(widths_of_band * largest * n_edges / total));
    }
    return n_rings;
}

}  // namespace

std::vector<RimCurve> find_rim_curves(const PolygonMesh& mesh, const Topology& topology)
{
    std::vector<RimCurve> curves;
    const std::vector<Segment> segments = segments_of(mesh, topology);
    const auto n = static_cast<Index>(segments.size());
    const IndexLists at_vertex = make_lists(mesh.n_vertices(), [&](auto&& enter) {
        for (Index s = 0; s < n; ++s)
            for (const Index v : segments[s].ends)
                enter(v, s);
    });
    std::vector<std::uint8_t> is_taken(segments.size(), 0);
    const auto follow = [&](Index start, Index first) {
        RimCurve curve{{start}, {}, {}, false};
        Index v = start;
        for (Index s = first; s >= 0;) {
            is_taken[s] = 1;
            const bool is_along = segments[s].ends[0] == v;
            curve.faces.push_back(segments[s].face);
            curve.senses.push_back(is_along ? 1.0 : -1.0);
            v = segments[s].ends[is_along ? 1 : 0];
            if (v == start)
                break;
            curve.vertices.push_back(v);
            const auto around = at_vertex[v];
            const Index next = around.size() != 2 ? Index{-1} : around[around[0] == s ? 1 : 0];
            s = next >= 0 && is_taken[next] == 0 ? next : Index{-1};
        }
        curve.is_closed = v == start && at_vertex[start].size() == 2 && curve.faces.size() > 2;
        curves.push_back(std::move(curve));
    };
    // Open curves first, from their ends; the rest are closed.
    for (const bool begins_at_ends : {true, false})
        for (Index s = 0; s < n; ++s)
            for (const Index v : segments[s].ends)
                if (is_taken[s] == 0 && (!begins_at_ends || at_vertex[v].size() != 2))
                    follow(v, s);
    return curves;
}

SmoothCurve smooth_curve(const RimCurve& curve, const Points& positions, double radius, bool keeps_corners)
{
    const auto n = static_cast<Index>(positions.rows());
    const Index n_edges = curve.is_closed ? n : n - 1;
    const auto next = [&](Index i) { return i + 1 < n ? i + 1 : Index{0}; };
    const auto previous = [&](Index i) { return i > 0 ? i - 1 : n - 1; };
    Eigen::VectorXd h(n);
    for (Index i = 0; i < n; ++i)
        h[i] = (positions.row(next(i)) - positions.row(i)).norm();
    const double mean = h.head(n_edges).sum() / static_cast<double>(std::max(n_edges, Index{1}));
    SmoothCurve smooth{positions, std::vector<double>(usize(n), 1.0)};
    // A vertex is coupled with two vertices on either side. Shorter curves stay as they are.
    constexpr Index fewest = 5;
    if (n < fewest || !(mean > 0.0))
        return smooth;
    h = h.cwiseMax(shortest_edge * mean);
    const auto is_end = [&](Index i) { return !curve.is_closed && (i == 0 || i == n - 1); };
    const auto length_at = [&](Index i) { return is_end(i) ? h[i == 0 ? 0 : n - 2] : 0.5 * (h[previous(i)] + h[i]); };
    // The three vertices of b_i, and their coefficients.
    const auto bend = [&](Index i) {
        const std::array<Index, 3> at{previous(i), i, next(i)};
        const double before = 1.0 / h[previous(i)];
        const double after = 1.0 / h[i];
        return std::pair(at, std::array{before, -(before + after), after});
    };
    const double amount = std::pow(2.0 * radius / std::numbers::pi, 4);
    for (int round = 0; round < (keeps_corners ? rounds_for_corners : 1); ++round) {
        // The ends of an open curve stay: their equations are x = p, and their coefficients in other equations move to
        // the right-hand side.
        BandedEquations equations(n, curve.is_closed);
        Points right_hand_side(n, 3);
        for (Index i = 0; i < n; ++i) {
            equations.add(i, i, is_end(i) ? 1.0 : length_at(i));
            right_hand_side.row(i) = (is_end(i) ? 1.0 : length_at(i)) * positions.row(i);
        }
        for (Index i = 0; i < n; ++i) {
            if (is_end(i))
                continue;
            const auto [at, b] = bend(i);
            const double weight = amount * smooth.smoothness[i] / length_at(i);
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t l = 0; l < 3; ++l) {
                    if (is_end(at[k]))
                        continue;
                    if (is_end(at[l]))
                        right_hand_side.row(at[k]) -= weight * b[k] * b[l] * positions.row(at[l]);
                    else
                        equations.add(at[k], at[l], weight * b[k] * b[l]);
                }
        }
        smooth.positions = equations.solve(right_hand_side);
        for (Index i = 0; keeps_corners && i < n; ++i) {
            if (is_end(i))
                continue;
            const auto [at, b] = bend(i);
            Point sum = Point::Zero();
            for (std::size_t k = 0; k < 3; ++k)
                sum += b[k] * smooth.positions.row(at[k]);
            const double turn = radius * sum.norm() / length_at(i) / turn_at_corners;
            smooth.smoothness[i] = 1.0 / (1.0 + std::pow(turn, 4));
        }
    }
    return smooth;
}

Points across_curve(const RimCurve& curve, const Points& positions, const Points& normals)
{
    const auto n = static_cast<Index>(positions.rows());
    const Points of_vertices = normals_along(curve, normals);
    Points across(n, 3);
    for (Index i = 0; i < n; ++i) {
        const bool has_both = curve.is_closed || (i > 0 && i + 1 < n);
        const Index from = i > 0 ? i - 1 : has_both ? n - 1 : i;
        const Index to = i + 1 < n ? i + 1 : has_both ? Index{0} : i;
        const Point along = positions.row(to) - positions.row(from);
        const Point normal = of_vertices.row(i);
        across.row(i) = unit_or_zero(along.cross(normal));
    }
    return across;
}

void keep_areas(const PolygonMesh& mesh, const Points& positions, const Points& normals, Points& motions)
{
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (std::ranges::any_of(mesh.face(f), [&](Index v) { return !motions.row(v).isZero(0.0); }))
            faces.push_back(f);
    std::vector<std::uint8_t> is_shortened(usize(mesh.n_vertices()));
    Points moved = positions;
    for (int round = 0; round < most_shortenings; ++round) {
        for (const Index f : faces)
            for (const Index v : mesh.face(f)) {
                moved.row(v) = positions.row(v) + motions.row(v);
                is_shortened[v] = 0;
            }
        for (const Index f : faces) {
            const Point normal = normals.row(f);
            const double before = vector_area(mesh.face(f), positions).dot(normal);
            if (before > 0.0 && vector_area(mesh.face(f), moved).dot(normal) < least_area * before)
                for (const Index v : mesh.face(f))
                    is_shortened[v] = 1;
        }
        bool any = false;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (is_shortened[v] != 0) {
                motions.row(v) *= shortening;
                any = true;
            }
        if (!any)
            return;
    }
}

void spread_into_band(const PolygonMesh& mesh, const Topology& topology, std::span<const RimCurve> curves,
                      const VertexNormals& normals, const Points& positions, Points& motions)
{
    constexpr Index unreached = -1;
    std::vector<Index> ring(usize(mesh.n_vertices()), unreached);
    std::vector<Index> front;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Boundary) {
            ring[v] = 0;
            if (!motions.row(v).isZero(0.0))
                front.push_back(v);
        }
    std::vector<Index> n_rings = rings_of_bands(mesh, topology, curves, positions, motions);
    for (Index k = 1; !front.empty(); ++k) {
        std::vector<Index> further;
        for (const Index v : front)
            if (k <= n_rings[v])
                visit_neighbours(mesh, topology, v, [&](Index w) {
                    if (ring[w] == unreached) {
                        ring[w] = k;
                        further.push_back(w);
                    }
                });
        std::ranges::sort(further);
        for (const Index v : further) {
            double count = 0.0;
            visit_neighbours(mesh, topology, v, [&](Index w) {
                if (ring[w] == k - 1) {
                    motions.row(v) += motions.row(w);
                    n_rings[v] = std::max(n_rings[v], n_rings[w]);
                    count += 1.0;
                }
            });
            motions.row(v) /= count;
        }
        front.swap(further);
    }
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (ring[v] <= 0)
            continue;
        const Point normal = normals(topology.corners_at(v), positions);
        const double fraction = topology.moves(v) ? 1.0 - static_cast<double>(ring[v]) / (n_rings[v] + 1.0) : 0.0;
        const Point motion = motions.row(v);
        motions.row(v) = fraction * (motion - motion.dot(normal) * normal);
    }
}

}  // namespace seamflow
