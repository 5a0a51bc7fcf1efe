#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "partition/metrics/bounding_box.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"
#include "tests/support/writings.h"

namespace seamflow::test {

namespace {

/// Vertex v becomes new_vertex[v], and face f comes from old_face[f].
void renumber(Writing& w, const std::vector<Index>& new_vertex, const std::vector<Index>& old_face)
{
    w.mesh = test::renumbered(w.mesh, new_vertex, old_face);
    const std::vector<Index> vertex_from = w.vertex_from;
    const std::vector<Index> face_from = w.face_from;
    for (std::size_t v = 0; v < vertex_from.size(); ++v)
        w.vertex_from[new_vertex[v]] = vertex_from[v];
    for (std::size_t f = 0; f < face_from.size(); ++f)
        w.face_from[f] = face_from[old_face[f]];
}

std::vector<Index> ascending_numbers(std::size_t n)
{
    std::vector<Index> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

void shuffle_vertices(Writing& w)
{
    RandomNumbers random(11);
    renumber(w, random_permutation(w.mesh.n_vertices(), random), ascending_numbers(w.face_from.size()));
}

void reverse_vertices(Writing& w)
{
    std::vector<Index> numbers = ascending_numbers(w.vertex_from.size());
    std::ranges::reverse(numbers);
    renumber(w, numbers, ascending_numbers(w.face_from.size()));
}

/// Calls change(corners of f) for every face.
template <class OnFace>
void change_faces(Writing& w, OnFace&& change)
{
    LooseMesh loose = loosened(w.mesh);
    for (std::size_t f = 0; f < loose.faces.size(); ++f)
        change(f, loose.faces[f]);
    w.mesh = tightened(loose);
}

/// Another order of faces, and another first corner of each.
void shuffle_faces(Writing& w)
{
    RandomNumbers random(12);
    renumber(w, ascending_numbers(w.vertex_from.size()), random_permutation(w.mesh.n_faces(), random));
    change_faces(w, [&](std::size_t, std::vector<Index>& corners) {
        std::rotate(corners.begin(), corners.begin() + random.below(static_cast<int>(corners.size())), corners.end());
    });
}

void turn_faces_round(Writing& w)
{
    change_faces(w, [](std::size_t, std::vector<Index>& corners) { std::ranges::reverse(corners); });
}

void turn_some_faces_round(Writing& w)
{
    change_faces(w, [](std::size_t f, std::vector<Index>& corners) {
        if (f % 3 == 1)
            std::ranges::reverse(corners);
    });
}

void transform(Writing& w, double scale, const Eigen::Matrix3d& turn, const Point& shift)
{
    const auto moved = [&](const Points& p) { return Points((scale * p * turn.transpose()).rowwise() + shift); };
    w.mesh.vertices = moved(w.mesh.vertices);
    w.scale *= scale;
    w.turn = turn * w.turn;
    w.shift = moved(w.shift);
}

void scale(Writing& w, double factor)
{
    transform(w, factor, Eigen::Matrix3d::Identity(), Point::Zero());
}

void move_away(Writing& w)
{
    transform(w, 1.0, Eigen::Matrix3d::Identity(), Point(1e6, -3e6, 2e6));
}

void turn(Writing& w)
{
    const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -0.5).normalized();
    transform(w, 1.0, Eigen::AngleAxisd(0.7, axis).toRotationMatrix(), Point::Zero());
}

void store_as_floats(Writing& w)
{
    w.mesh.vertices = w.mesh.vertices.cast<float>().cast<double>();
}

/// Seams through the middle of the surface; copies come last.
void double_seams(Writing& w)
{
    std::vector<Index> labels;
    const Point middle = w.mesh.vertices.colwise().mean();
    for (Index f = 0; f < w.mesh.n_faces(); ++f) {
        const Point side = centroid(w.mesh.face(f), w.mesh.vertices) - middle;
        labels.push_back((side.x() < 0.1 * side.z() ? 0 : 1) + (side.y() < 0.0 ? 0 : 2));
    }
    const PolygonMesh before = std::exchange(w.mesh, split(w.mesh, labels));
    const std::vector<Index> vertex_from = w.vertex_from;
    w.vertex_from.resize(usize(w.mesh.n_vertices()));
    for (std::size_t corner = 0; corner < before.face_vertices.size(); ++corner)
        w.vertex_from[w.mesh.face_vertices[corner]] = vertex_from[before.face_vertices[corner]];
}

void double_seams_copies_first(Writing& w)
{
    double_seams(w);
    reverse_vertices(w);
}

void repeat_faces(Writing& w)
{
    LooseMesh loose = loosened(w.mesh);
    const auto n_faces = loose.faces.size();
    for (std::size_t f = 0; f < n_faces; ++f) {
        loose.faces.emplace_back(loose.faces[f].rbegin(), loose.faces[f].rend());
        w.face_from.push_back(w.face_from[f]);
    }
    w.mesh = tightened(loose);
}

/// Another mesh beside it, with the lowest numbers.
void put_before(Writing& w, const PolygonMesh& other)
{
    w.mesh = together({other, w.mesh});
    w.vertex_from.insert(w.vertex_from.begin(), usize(other.n_vertices()), -1);
    w.face_from.insert(w.face_from.begin(), usize(other.n_faces()), -1);
}

void add_unused_vertex(Writing& w)
{
    PolygonMesh other;
    other.vertices = 1e3 * w.mesh.vertices.topRows(1);
    put_before(w, other);
}

/// A flat grid, which stays as it is.
void add_body(Writing& w)
{
    const double size = box_of_faces(w.mesh).diagonal();
    PolygonMesh other = quad_grid(8, 7);
    other.vertices *= 4.0 * size;
    other.vertices.rowwise() += Point(0.0, 300.0 * size, 100.0 * size);
    put_before(w, other);
    w.has_other_faces = true;
}

/// The edge of a face that begins at one of its corners.
struct EdgeOfFace {
    std::size_t face;
    std::size_t corner;
};

/// Some edge of the boundary, or one between vertices that move; nothing if there is none.
std::optional<EdgeOfFace> some_edge(const PolygonMesh& mesh, bool at_boundary)
{
    const Topology topology = make_topology(mesh);
    for (Index h = mesh.n_corners() / 2; h < mesh.n_corners(); ++h) {
        const Index f = topology.face_of[usize(h)];
        const auto moves = [&](Index c) { return topology.kind[mesh.face_vertices[c]] == VertexKind::Interior; };
        if ((topology.twin[h] < 0) == at_boundary && (at_boundary || (moves(h) && moves(topology.next(mesh, h)))))
            return EdgeOfFace{usize(f), usize(h - mesh.face_offsets[f])};
    }
    return {};
}

/// A vertex in the middle of an edge of one face, and a triangle without area between the two halves and the whole.
void insert_sliver(Writing& w, bool at_boundary)
{
    const std::optional<EdgeOfFace> edge = some_edge(w.mesh, at_boundary);
    if (!edge)
        return;
    LooseMesh loose = loosened(w.mesh);
    std::vector<Index>& corners = loose.faces[edge->face];
    const Index a = corners[edge->corner];
    const Index b = corners[(edge->corner + 1) % corners.size()];
    const Index middle = loose.n_points();
    loose.points.push_back(0.5 * (loose.points[a] + loose.points[b]));
    if (!at_boundary)
        corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(edge->corner) + 1, middle);
    loose.faces.push_back(at_boundary ? std::vector{b, a, middle} : std::vector{a, b, middle});
    w.mesh = tightened(loose);
    w.vertex_from.push_back(-1);
    w.face_from.push_back(w.face_from[edge->face]);
    w.has_other_faces = true;
}

/// Closes the smallest hole by a polygon; its rim has to be held then.
void close_hole(Writing& w)
{
    const Topology topology = make_topology(w.mesh);
    std::map<Index, Index> next;
    for (Index h = 0; h < w.mesh.n_corners(); ++h)
        if (topology.twin[h] < 0)
            next[w.mesh.face_vertices[topology.next(w.mesh, h)]] = w.mesh.face_vertices[h];
    std::vector<Index> smallest;
    while (!next.empty()) {
        std::vector<Index> rim;
        for (auto at_v = next.begin(); at_v != next.end(); at_v = next.find(rim.back())) {
            rim.push_back(at_v->second);
            next.erase(at_v);
        }
        if (smallest.empty() || rim.size() < smallest.size())
            smallest = rim;
    }
    if (smallest.empty())
        return;
    w.mesh.add_face(smallest);
    w.face_from.push_back(0);
    w.has_other_faces = true;
    for (const Index v : smallest)
        w.held.push_back(w.vertex_from[v]);
}

}  // namespace

Writing Change::operator()(const PolygonMesh& mesh) const
{
    Writing w{.mesh = mesh,
              .vertex_from = ascending_numbers(usize(mesh.n_vertices())),
              .face_from = ascending_numbers(usize(mesh.n_faces()))};
    for (const auto& step : steps)
        step.make(w);
    return w;
}

std::string Change::name() const
{
    std::string text;
    for (const auto& step : steps)
        text += (text.empty() ? "" : ", ") + std::string(step.name);
    return text;
}

double Change::tolerance() const
{
    return std::ranges::max(steps, {}, &SimpleChange::tolerance).tolerance;
}

bool Change::has(std::string_view name) const
{
    return std::ranges::find(steps, name, &SimpleChange::name) != steps.end();
}

Change changes_named(std::initializer_list<std::string_view> names)
{
    Change change;
    for (const std::string_view name : names)
        change.steps.push_back(*std::ranges::find(simple_changes(), name, &SimpleChange::name));
    return change;
}

const std::vector<SimpleChange>& simple_changes()
{
    // Coordinates some 1e6 away have 1e-9 mean edges of rounding, floats 1e-6; flows make more of it.
    constexpr double rounding = 1e-8;
    static const std::vector<SimpleChange> list{
        {"vertices renumbered", shuffle_vertices, rounding},
        {"faces reordered", shuffle_faces, rounding},
        {"faces turned round", turn_faces_round, rounding},
        {"some faces turned round", turn_some_faces_round, rounding},
        {"in thousandths", [](Writing& w) { scale(w, 1e3); }, rounding},
        {"times a power of two", [](Writing& w) { scale(w, 0x1p-20); }, 0.0},
        {"far away", move_away, 1e-6},
        {"turned", turn, rounding},
        {"seams", double_seams, rounding},
        {"seams, copies first", double_seams_copies_first, rounding},
        {"faces twice", repeat_faces, rounding},
        {"unused vertex", add_unused_vertex, rounding},
        {"second body", add_body, rounding},
        {"floats", store_as_floats, 1e-4},
        {"sliver at the boundary", [](Writing& w) { insert_sliver(w, true); }, rounding},
        {"sliver inside", [](Writing& w) { insert_sliver(w, false); }, 0.5},
        {"hole closed", close_hole, rounding},
    };
    return list;
}

PolygonMesh creased_sheet()
{
    PolygonMesh mesh = make_mixed_polygons(150, {.surface = {.noise = 0.2}, .jitter = 0.1});
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices(v, 2) += std::abs(mesh.vertices(v, 0) - 0.45);
    // A hole around the vertex that is nearest to a place.
    Index middle = 0;
    (mesh.vertices.rowwise() - Point(0.7, 0.6, 0.3)).rowwise().norm().minCoeff(&middle);
    LooseMesh loose = loosened(mesh);
    std::erase_if(loose.faces, [&](const auto& face) { return std::ranges::find(face, middle) != face.end(); });
    // The hole has no vertex in it.
    loose.points.erase(loose.points.begin() + middle);
    for (auto& face : loose.faces)
        for (Index& v : face)
            v -= v > middle ? 1 : 0;
    return tightened(loose);
}

PolygonMesh rimmed_ball()
{
    PolygonMesh mesh = make_noisy_sphere(180);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices(v, 2) = std::max(mesh.vertices(v, 2), -0.4 + 0.1 * mesh.vertices(v, 0));
    return mesh;
}

}  // namespace seamflow::test
