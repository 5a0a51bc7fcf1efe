#include "tests/support/test_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "samples/meshes/meshes.h"

namespace seamflow::test {

namespace {

void add_quad(PolygonMesh& mesh, const std::array<Index, 4>& q, bool as_triangles)
{
    if (!as_triangles) {
        mesh.add_face(q);
        return;
    }
    mesh.add_face(std::array{q[0], q[1], q[2]});
    mesh.add_face(std::array{q[0], q[2], q[3]});
}

PolygonMesh grid(Index m, Index n, bool as_triangles)
{
    PolygonMesh mesh;
    mesh.vertices.resize((m + 1) * (n + 1), 3);
    for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i <= m; ++i)
            mesh.vertices.row(j * (m + 1) + i) << i, j, 0;
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < m; ++i) {
            const Index a = j * (m + 1) + i;
            add_quad(mesh, {a, a + 1, a + m + 2, a + m + 1}, as_triangles);
        }
    return mesh;
}

PolygonMesh torus(Index m, Index n, bool as_triangles)
{
    PolygonMesh mesh;
    mesh.vertices.resize(m * n, 3);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < m; ++i) {
            const double u = 2 * std::numbers::pi * i / m;
            const double v = 2 * std::numbers::pi * j / n;
            const double r = 3 + std::cos(v);
            mesh.vertices.row(j * m + i) << r * std::cos(u), r * std::sin(u), std::sin(v);
            const Index right = (i + 1) % m;
            const Index up = (j + 1) % n;
            add_quad(mesh, {j * m + i, j * m + right, up * m + right, up * m + i}, as_triangles);
        }
    return mesh;
}

PolygonMesh from_faces(Index n_vertices, const std::vector<std::vector<Index>>& faces)
{
    PolygonMesh mesh;
    mesh.vertices.resize(n_vertices, 3);
    for (Index v = 0; v < n_vertices; ++v)
        mesh.vertices.row(v) << v, v * v % 7, v % 3;
    for (const auto& face : faces)
        mesh.add_face(face);
    return mesh;
}

}  // namespace

PolygonMesh quad_grid(Index m, Index n)
{
    return grid(m, n, false);
}

PolygonMesh triangle_grid(Index m, Index n)
{
    return grid(m, n, true);
}

PolygonMesh quad_torus(Index m, Index n)
{
    return torus(m, n, false);
}

PolygonMesh triangle_torus(Index m, Index n)
{
    return torus(m, n, true);
}

PolygonMesh cylinder(Index m, Index n)
{
    PolygonMesh mesh;
    mesh.vertices.resize(m * (n + 1), 3);
    for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i < m; ++i) {
            const double u = 2 * std::numbers::pi * i / m;
            mesh.vertices.row(j * m + i) << std::cos(u), std::sin(u), j;
            if (j < n)
                mesh.add_face(std::array{j * m + i, j * m + (i + 1) % m, (j + 1) * m + (i + 1) % m, (j + 1) * m + i});
        }
    return mesh;
}

PolygonMesh cup(Index m, Index n)
{
    PolygonMesh mesh = cylinder(m, n);
    for (Index i = 0; i < mesh.n_vertices(); ++i)
        mesh.vertices.row(i) *= 1.0 + 0.01 * (i * 37 % 11);
    std::vector<Index> bottom;
    for (Index i = m - 1; i >= 0; --i)
        bottom.push_back(i);
    mesh.add_face(bottom);
    return mesh;
}

PolygonMesh moebius_band(Index m, Index n)
{
    PolygonMesh mesh;
    mesh.vertices.resize(m * (n + 1), 3);
    const auto vertex = [&](Index i, Index j) { return i < m ? i * (n + 1) + j : n - j; };
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j <= n; ++j) {
            const double u = 2 * std::numbers::pi * i / m;
            const double across = 2.0 * j / n - 1.0;
            const double r = 3 + across * std::cos(u / 2);
            mesh.vertices.row(vertex(i, j)) << r * std::cos(u), r * std::sin(u), across * std::sin(u / 2);
            if (j < n)
                mesh.add_face(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    return mesh;
}

PolygonMesh hexagon_sheet(Index m, Index n)
{
    // A brick wall: bricks two cells wide, each row shifted by one cell; a brick has six corners.
    const Index width = 2 * m + 2;
    PolygonMesh mesh;
    mesh.vertices.resize(width * (n + 1), 3);
    for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i < width; ++i)
            mesh.vertices.row(j * width + i) << i, j + ((i + j) % 2 == 0 ? 0.2 : -0.2), 0;
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < m; ++i) {
            const Index a = j * width + 2 * i + j % 2;
            mesh.add_face(std::array{a, a + 1, a + 2, a + width + 2, a + width + 1, a + width});
        }
    return mesh;
}

PolygonMesh bow_tie()
{
    return from_faces(7, {{0, 1, 2, 3}, {3, 4, 5, 6}});
}

PolygonMesh three_wings()
{
    return from_faces(5, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
}

PolygonMesh hourglass()
{
    return from_faces(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {6, 5, 4}});
}

PolygonMesh side_by_side(const std::vector<PolygonMesh>& meshes)
{
    std::vector<PolygonMesh> moved = meshes;
    Index n_before = 0;
    for (PolygonMesh& mesh : moved) {
        mesh.vertices.col(2).array() += 10.0 * n_before;
        n_before += mesh.n_faces();
    }
    return together(moved);
}

PolygonMesh ball(double size, const Point& centre, Index vertices)
{
    PolygonMesh mesh = make_noisy_sphere(vertices);
    mesh.vertices *= size;
    mesh.vertices.rowwise() += centre;
    return mesh;
}

PolygonMesh together(const std::vector<PolygonMesh>& meshes)
{
    PolygonMesh all;
    for (const PolygonMesh& mesh : meshes) {
        const Index first = all.n_vertices();
        all.vertices.conservativeResize(first + mesh.n_vertices(), 3);
        all.vertices.bottomRows(mesh.n_vertices()) = mesh.vertices;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
            std::for_each(corners.begin(), corners.end(), [&](Index& v) { v += first; });
            all.add_face(corners);
        }
    }
    return all;
}

PolygonMesh with_faces_flipped(const PolygonMesh& mesh, std::uint32_t seed)
{
    std::mt19937 generator(seed);
    PolygonMesh flipped;
    flipped.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        if (generator() % 2 == 0)
            std::reverse(corners.begin(), corners.end());
        flipped.add_face(corners);
    }
    return flipped;
}

PolygonMesh split(const PolygonMesh& mesh, const std::vector<Index>& labels)
{
    PolygonMesh parts = mesh;
    std::map<std::pair<Index, Index>, Index> copies;
    std::vector<Index> first_label(usize(mesh.n_vertices()), -1);
    std::vector<Index> copied;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (Index corner = mesh.face_offsets[f]; corner < mesh.face_offsets[f + 1]; ++corner) {
            const Index v = mesh.face_vertices[corner];
            if (first_label[v] < 0)
                first_label[v] = labels[f];
            if (first_label[v] == labels[f])
                continue;
            const auto [copy, is_new] =
                copies.try_emplace({v, labels[f]}, mesh.n_vertices() + static_cast<Index>(copied.size()));
            if (is_new)
                copied.push_back(v);
            parts.face_vertices[corner] = copy->second;
        }
    parts.vertices.conservativeResize(mesh.n_vertices() + static_cast<Index>(copied.size()), 3);
    for (std::size_t i = 0; i < copied.size(); ++i)
        parts.vertices.row(mesh.n_vertices() + static_cast<Index>(i)) = mesh.vertices.row(copied[i]);
    return parts;
}

std::vector<Index> halves(const PolygonMesh& mesh, double middle)
{
    std::vector<Index> labels;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        labels.push_back(mesh.vertices(mesh.face(f).front(), 0) < middle ? 0 : 1);
    return labels;
}

std::vector<Index> originals(const PolygonMesh& parts, const PolygonMesh& whole)
{
    std::vector<Index> of(usize(parts.n_vertices()));
    for (std::size_t corner = 0; corner < parts.face_vertices.size(); ++corner)
        of[parts.face_vertices[corner]] = whole.face_vertices[corner];
    return of;
}

std::vector<NamedMesh> assorted_meshes()
{
    std::vector<NamedMesh> meshes;
    const auto add = [&](const std::string& name, PolygonMesh mesh) {
        Topology topology = make_topology(mesh);
        meshes.push_back({name, std::move(mesh), std::move(topology)});
    };
    add("quad grid", quad_grid(12, 9));
    add("triangle grid", triangle_grid(9, 9));
    add("quad torus", quad_torus(14, 8));
    add("triangle torus", triangle_torus(11, 9));
    add("smallest torus", triangle_torus(3, 3));
    add("cylinder", cylinder(9, 12));
    add("hexagons", hexagon_sheet(9, 9));
    add("bow tie", bow_tie());
    add("three wings", three_wings());
    add("hourglass", hourglass());
    add("one face", quad_grid(1, 1));
    add("no face", PolygonMesh{});
    add("several", side_by_side({quad_grid(6, 6), triangle_torus(7, 6), quad_grid(1, 1), hourglass(), cylinder(5, 4)}));
    return meshes;
}

std::vector<Index> random_labels(Index n_faces, Index k, std::uint32_t seed)
{
    // Not a standard distribution: those differ between libraries.
    std::mt19937 generator(seed);
    std::vector<Index> labels(static_cast<std::size_t>(n_faces));
    for (Index& label : labels)
        label = static_cast<Index>(generator() % static_cast<std::uint32_t>(k));
    return labels;
}

}  // namespace seamflow::test
