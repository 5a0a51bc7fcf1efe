#include "solvers/laplacian/intrinsic_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// A weight nearer to 0 than this fraction of its two cotangents, or of 1, is not worth a flip, which rounding could
/// undo.
constexpr double negligible = 1e-7;
/// The least sine of an angle: triangles without area have corners between others, and one flip mends them.
constexpr double thinnest = 1e-12;
/// The most flips per edge: rounding could flip an edge for ever; no surface needs nearly as many flips.
constexpr std::size_t most_flips = 1000;

double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

/// The product of complex numbers.
Eigen::RowVector2d product(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b)
{
    return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}

}  // namespace

IntrinsicTriangles::IntrinsicTriangles(const PolygonMesh& mesh, const Topology& topology)
    : corners_(usize(mesh.n_faces()))
    , edges_(mesh.face_vertices.size())
    , twin_(topology.twin)
{
    for (Index t = 0; t < mesh.n_faces(); ++t) {
        const auto face = mesh.face(t);
        corners_[t] = {face[0], face[1], face[2]};
        const Point along = mesh.vertices.row(face[1]) - mesh.vertices.row(face[0]);
        const Point after = mesh.vertices.row(face[2]) - mesh.vertices.row(face[1]);
        const double length = along.norm();
        const double unit = length > 0.0 ? 1.0 / length : 0.0;
        edges_[3 * t] = {length, 0.0};
        edges_[3 * t + 1] = {unit * after.dot(along), unit * along.cross(after).norm()};
        edges_[3 * t + 2] = -edges_[3 * t] - edges_[3 * t + 1];
    }
}

double IntrinsicTriangles::area(Index t) const
{
    return 0.5 * std::abs(cross(edge(3 * t), edge(3 * t + 1)));
}

double IntrinsicTriangles::half_cotangent(Index h) const
{
    const Vector& a = edge(next(h));
    const Vector& b = edge(previous(h));
    const double size = a.norm() * b.norm();
    return size > 0.0 ? -0.5 * a.dot(b) / std::max(std::abs(cross(a, b)), thinnest * size) : 0.0;
}

/// Whether the weight of the edge of h is below 0 by more than rounding.
bool IntrinsicTriangles::is_far_from_delaunay(Index h) const
{
    const double here = half_cotangent(h);
    const double there = half_cotangent(twin(h));
    return here + there < -negligible * (1.0 + std::abs(here) + std::abs(there));
}

/// Whether an edge joins the start of h with v, among the triangles that are connected by edges around that start.
bool IntrinsicTriangles::are_joined(Index h, Index v) const
{
    const Index centre = start(h);
    for (const Index first : {h, previous(h)})
        for (Index across = first;;) {
            const Index t = across / 3;
            if (corners_[t][0] == v || corners_[t][1] == v || corners_[t][2] == v)
                return true;
            const Index there = twin(across);
            if (there < 0)
                break;
            // The other half-edge at the centre.
            across = start(there) == centre ? previous(there) : next(there);
            if (across / 3 == h / 3)
                return false;
        }
    return false;
}

/// Reverses the order of the corners of triangle t.
void IntrinsicTriangles::turn_over(Index t)
{
    std::swap(corners_[t][1], corners_[t][2]);
    const std::array old_twins{twin_[3 * t], twin_[3 * t + 1], twin_[3 * t + 2]};
    const std::array old_edges{edges_[3 * t], edges_[3 * t + 1], edges_[3 * t + 2]};
    for (Index k = 0; k < 3; ++k) {
        const auto old = static_cast<std::size_t>(2 - k);
        edges_[3 * t + k] = {-old_edges[old].x(), old_edges[old].y()};
        make_twins(3 * t + k, old_twins[old]);
    }
}

/// Makes two half-edges twins of each other.
/// @param twin -1 if h has none.
void IntrinsicTriangles::make_twins(Index h, Index twin)
{
    twin_[h] = twin;
    if (twin >= 0)
        twin_[twin] = h;
}

/// Flips an edge: triangles a, b, c and b, a, d become a, d, c and b, c, d.
/// @returns whether that was possible.
bool IntrinsicTriangles::flip(Index h, const Points& positions)
{
    const Index a = start(h);
    const Index c = start(previous(h));
    const Index t = h / 3;
    const Index s = twin(h) / 3;
    const Index d = start(previous(twin(h)));
    if (s == t || c == d || are_joined(previous(h), d))
        return false;
    if (start(twin(h)) == a)
        turn_over(s);
    const Index g = twin(h);
    const Index b = start(g);
    // The edges of the other triangle, rotated into the plane of this one.
    const Vector turn = product(-edge(h), {edge(g).x(), -edge(g).y()}).normalized();
    const Vector ad = product(edge(next(g)), turn);
    const Vector db = product(edge(previous(g)), turn);
    const Vector bc = edge(next(h));
    const Vector ca = edge(previous(h));
    const Vector cd = 0.5 * ((ca + ad) - (bc + db));
    // Both new triangles need an area, in their plane and at the positions.
    if (!(cross(ad, -cd) > 0.0 && cross(bc, cd) > 0.0) ||
        !std::isnormal(seamflow::area(std::array{a, d, c}, positions)) ||
        !std::isnormal(seamflow::area(std::array{b, c, d}, positions)))
        return false;
    const std::array around{twin(next(g)), twin(previous(h)), twin(next(h)), twin(previous(g))};
    corners_[t] = {a, d, c};
    corners_[s] = {b, c, d};
    edges_[3 * t] = ad;
    edges_[3 * t + 1] = -cd;
    edges_[3 * t + 2] = ca;
    edges_[3 * s] = bc;
    edges_[3 * s + 1] = cd;
    edges_[3 * s + 2] = db;
    make_twins(3 * t, around[0]);
    make_twins(3 * t + 1, 3 * s + 1);
    make_twins(3 * t + 2, around[1]);
    make_twins(3 * s, around[2]);
    make_twins(3 * s + 2, around[3]);
    return true;
}

void IntrinsicTriangles::flip_to_delaunay(const Points& positions)
{
    std::vector<Index> to_look_at;
    for (auto h = static_cast<Index>(twin_.size()); h-- > 0;)
        if (twin_[h] > h)
            to_look_at.push_back(h);
    std::size_t n_left = most_flips * to_look_at.size();
    while (!to_look_at.empty() && n_left > 0) {
        const Index h = to_look_at.back();
        to_look_at.pop_back();
        if (twin(h) < 0 || !is_far_from_delaunay(h))
            continue;
        const Index t = h / 3;
        const Index s = twin(h) / 3;
        if (!flip(h, positions))
            continue;
        --n_left;
        to_look_at.insert(to_look_at.end(), {3 * t, 3 * t + 2, 3 * s, 3 * s + 2});
    }
}

}  // namespace seamflow
