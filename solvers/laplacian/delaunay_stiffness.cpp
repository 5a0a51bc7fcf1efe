#include "solvers/laplacian/delaunay_stiffness.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "partition/metrics/triangulation.h"
#include "solvers/laplacian/intrinsic_triangles.h"
#include "solvers/laplacian/vertex_row.h"

namespace seamflow {

namespace {

/// Weights are cotangents, without a unit: weights nearer to 0 than this are rounding errors of positions.
constexpr double negligible_weight = 1e-8;

/// Whether a weight -K_vw of a row is negative: whether K_vw exceeds negligible_weight for some w.
/// @param entries w, and the share of one face in K_vw, in any order; they become sorted. @param in_faces whether a
///        single share that is positive counts, too.
bool has_negative_weight(std::vector<std::pair<Index, double>>& entries, bool in_faces)
{
    if (in_faces && std::ranges::any_of(entries, [](const auto& e) { return e.second > negligible_weight; }))
        return true;
    std::ranges::sort(entries);
    for (auto entry = entries.begin(); entry != entries.end();) {
        double sum = 0.0;
        const Index w = entry->first;
        for (; entry != entries.end() && entry->first == w; ++entry)
            sum += entry->second;
        if (sum > negligible_weight)
            return true;
    }
    return false;
}

/// Whether any vertex that moves has a negative weight in its row.
bool has_negative_weights(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, bool in_faces,
                          const Executor& exec)
{
    return with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) {
        if constexpr (FaceKernel<Kernel>) {
            const double n = reduce(
                exec, mesh.n_vertices(), 0.0,
                [&](double& found, Index v) {
                    if (found > 0.0 || !topology.moves(v) || topology.corners_at(v).empty())
                        return;
                    thread_local std::vector<std::pair<Index, double>> entries;
                    entries.clear();
                    visit_row(kernel, mesh, topology, mesh.vertices, v,
                              [&](Index w, double k) { entries.emplace_back(w, k); });
                    found += has_negative_weight(entries, in_faces) ? 1.0 : 0.0;
                },
                [](double& found, double part) { found += part; });
            return n > 0.0;
        } else
            return false;
    });
}

/// Per edge, the longest edges first: its half-edges.
Lists<Index> edges_by_length(const IntrinsicTriangles& triangles)
{
    struct HalfEdgeOfPair {
        double length;
        Index least;
        Index most;
        Index halfedge;
    };
    std::vector<HalfEdgeOfPair> sorted_half_edges;
    for (Index h = 0; h < 3 * triangles.n_triangles(); ++h) {
        const Index twin = triangles.twin(h);
        if (twin >= 0 && twin < h)
            continue;
        const auto [least, most] = std::minmax({triangles.start(h), triangles.end(h)});
        sorted_half_edges.push_back({triangles.length(h), least, most, h});
    }
    // An edge of three triangles has no twins. Its half-edges have lengths that may differ by rounding.
    std::ranges::sort(sorted_half_edges, {},
                      [](const HalfEdgeOfPair& p) { return std::tuple(p.least, p.most, p.halfedge); });
    Lists<HalfEdgeOfPair> edges;
    for (const HalfEdgeOfPair& one : sorted_half_edges) {
        const auto& before = edges.values;
        const bool is_new = before.empty() || triangles.twin(one.halfedge) >= 0 ||
                            triangles.twin(before.back().halfedge) >= 0 || before.back().least != one.least ||
                            before.back().most != one.most;
        if (is_new && !before.empty())
            edges.close();
        edges.values.push_back(one);
    }
    edges.close();
    std::vector<Index> order(usize(edges.size()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order,
                             [&](Index a, Index b) { return edges[a].front().length > edges[b].front().length; });
    Lists<Index> sorted;
    for (const Index e : order) {
        for (const HalfEdgeOfPair& one : edges[e]) {
            sorted.values.push_back(one.halfedge);
            if (const Index twin = triangles.twin(one.halfedge); twin >= 0)
                sorted.values.push_back(twin);
        }
        sorted.close();
    }
    return sorted;
}

/// Moves the weight of half-edge h, which is opposite to an obtuse angle, towards 0. The energy of a linear function on
/// a triangle is that of its derivative along h and that of its derivative across h, the term of the bend. With the
/// weight w of h and x, y of the others, 4 (x y + w x + w y) = 1, so that w = 1 / (4 (x + y)) - b x y / (x + y), where
/// b = 1 is the factor of the term of the bend. b becomes the number that gives the new weight, at least 0, and x and y
/// become b x and b y.
/// @param weight the new weight of half-edge h. @param weights per half-edge; changed in the triangle of h.
void reduce_bend_term(Index h, double weight, std::vector<double>& weights)
{
    double& x = weights[IntrinsicTriangles::next(h)];
    double& y = weights[IntrinsicTriangles::previous(h)];
    const double across = std::max(0.25 - weight * (x + y), 0.0) / (x * y);
    weights[h] = weight;
    x *= across;
    y *= across;
}

/// The weights of edges, none below 0. A triangle is softened across its longest edge, which changes the other two
/// weights.
/// @returns per half-edge: its share of the weight of its edge.
std::vector<double> softened_weights(const IntrinsicTriangles& triangles, const Topology& topology)
{
    std::vector<double> weights(3 * usize(triangles.n_triangles()));
    for (Index h = 0; h < 3 * triangles.n_triangles(); ++h)
        weights[h] = triangles.half_cotangent(h);
    const Lists<Index> edges = edges_by_length(triangles);
    for (Index e = 0; e < edges.size(); ++e) {
        const Index v = triangles.start(edges[e].front());
        const Index w = triangles.end(edges[e].front());
        double above = 0.0;
        double below = 0.0;
        for (const Index h : edges[e])
            (weights[h] > 0.0 ? above : below) += weights[h];
        if (above + below < 0.0 && (topology.moves(v) || topology.moves(w)))
            for (const Index h : edges[e])
                if (weights[h] < 0.0)
                    // Afterwards the weights of the half-edges of this edge add up to 0.
                    reduce_bend_term(h, above / -below * weights[h], weights);
        double sum = 0.0;
        for (const Index h : edges[e])
            sum += weights[h];
        for (const Index h : edges[e])
            weights[h] = std::max(sum, 0.0) / static_cast<double>(edges[e].size());
    }
    return weights;
}

/// K with given weights, and M of the triangles.
/// @param weights per half-edge.
GivenStiffness stiffness_of(const IntrinsicTriangles& triangles, const std::vector<double>& weights, Index n_vertices)
{
    struct Entry {
        Index other;
        double weight;
    };
    Lists<Entry> entries = make_lists<Entry>(n_vertices, [&](auto&& add) {
        for (Index h = 0; h < 3 * triangles.n_triangles(); ++h) {
            add(triangles.start(h), Entry{triangles.end(h), weights[h]});
            add(triangles.end(h), Entry{triangles.start(h), weights[h]});
        }
    });
    GivenStiffness of;
    of.mass.assign(usize(n_vertices), 0.0);
    for (Index t = 0; t < triangles.n_triangles(); ++t)
        for (const Index v : triangles.corners(t))
            of.mass[v] += triangles.area(t) / 3.0;
    for (Index v = 0; v < n_vertices; ++v) {
        const auto row = std::span(entries.values).subspan(usize(entries.offsets[v]), entries[v].size());
        std::ranges::stable_sort(row, {}, &Entry::other);
        for (const Entry& entry : row) {
            if (std::ssize(of.neighbours.values) == of.neighbours.offsets.back() ||
                of.neighbours.values.back() != entry.other) {
                of.neighbours.values.push_back(entry.other);
                of.weights.push_back(0.0);
                of.n_faces.push_back(0);
            }
            of.weights.back() += entry.weight;
            ++of.n_faces.back();
        }
        of.neighbours.close();
    }
    return of;
}

}  // namespace

std::optional<DelaunaySurface> make_delaunay(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                             bool in_faces, const Executor& exec)
{
    if (!has_negative_weights(mesh, topology, laplacian, in_faces, exec))
        return std::nullopt;
    PolygonMesh cut;
    cut.vertices = mesh.vertices;
    DelaunaySurface surface;
    std::vector<Triangle> of_face;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        of_face.clear();
        triangulate(mesh.face(f), mesh.vertices, of_face);
        for (const Triangle& triangle : of_face)
            cut.add_face(triangle);
        surface.face_of.resize(usize(cut.n_faces()), f);
    }
    IntrinsicTriangles triangles(cut, make_topology(cut, exec));
    triangles.flip_to_delaunay(cut.vertices);
    surface.mesh.vertices = std::move(cut.vertices);
    for (Index t = 0; t < triangles.n_triangles(); ++t)
        surface.mesh.add_face(triangles.corners(t));
    surface.stiffness = stiffness_of(triangles, softened_weights(triangles, topology), mesh.n_vertices());
    return surface;
}

}  // namespace seamflow
