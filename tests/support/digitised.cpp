#include "tests/support/digitised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace seamflow::test {

namespace {

using Cell = std::array<Index, 3>;

/// Points of a lattice of n by n by n, and which of them are inside; none beyond it is.
struct Lattice {
    const Inside& inside;
    Index n;
    Point spacing;

    [[nodiscard]] Point place(const Cell& cell) const
    {
        const double middle = 0.5 * (n - 1);
        return Point(cell[0] - middle, cell[1] - middle, cell[2] - middle).cwiseProduct(spacing);
    }

    [[nodiscard]] bool has(const Cell& cell) const
    {
        return std::ranges::all_of(cell, [&](Index i) { return i >= 0 && i < n; }) && inside(place(cell));
    }
};

/// The number of a vertex, which is appended where it is new.
template <class Key>
class Vertices {
  public:
    Index number_of(const Key& key, const Point& place)
    {
        const auto [found, is_new] = numbers_.try_emplace(key, static_cast<Index>(places_.size()));
        if (is_new)
            places_.push_back(place);
        return found->second;
    }

    [[nodiscard]] Points points() const
    {
        Points points(static_cast<Index>(places_.size()), 3);
        for (Index v = 0; v < points.rows(); ++v)
            points.row(v) = places_[v];
        return points;
    }

  private:
    std::map<Key, Index> numbers_;
    std::vector<Point> places_;
};

/// The corners of the face of a unit cube at this side of an axis, counterclockwise from outside.
std::array<Cell, 4> face_of_cube(std::size_t axis, Index side)
{
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    std::array<Cell, 4> corners{};
    constexpr std::array<std::array<Index, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        Cell& corner = corners[side == 1 ? i : 3 - i];
        corner[axis] = side;
        corner[next] = around[i][0];
        corner[last] = around[i][1];
    }
    return corners;
}

Cell plus(const Cell& a, const Cell& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

void for_each_cell(Index begin, Index end, const std::function<void(const Cell&)>& visit)
{
    for (Index i = begin; i < end; ++i)
        for (Index j = begin; j < end; ++j)
            for (Index k = begin; k < end; ++k)
                visit({i, j, k});
}

/// The polygons in one cube: from each crossed edge, the next one around the polygon.
void add_polygons(const Lattice& lattice, const Cell& cube, Vertices<std::array<Index, 4>>& vertices, PolygonMesh& mesh)
{
    const auto crossing = [&](const Cell& a, const Cell& b) {
        const Cell& low = std::min(a, b);
        const auto axis = static_cast<Index>(std::ranges::mismatch(a, b).in1 - a.begin());
        return vertices.number_of({low[0], low[1], low[2], axis}, 0.5 * (lattice.place(a) + lattice.place(b)));
    };
    std::map<Index, Index> next;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const Index side : {0, 1}) {
            const std::array<Cell, 4> corners = face_of_cube(axis, side);
            const auto corner = [&](std::size_t i) { return plus(cube, corners[i % 4]); };
            for (std::size_t i = 0; i < 4; ++i) {
                if (!lattice.has(corner(i)) || lattice.has(corner(i + 1)))
                    continue;
                std::size_t back = i + 1;
                while (!lattice.has(corner(back + 1)))
                    ++back;
                next[crossing(corner(back), corner(back + 1))] = crossing(corner(i), corner(i + 1));
            }
        }
    while (!next.empty()) {
        std::vector<Index> polygon;
        for (auto at = next.begin(); at != next.end(); at = next.find(polygon.back())) {
            polygon.push_back(at->second);
            next.erase(at);
        }
        mesh.add_face(polygon);
    }
}

}  // namespace

PolygonMesh voxel_faces(const Inside& inside, Index n)
{
    const Lattice lattice{inside, n, Point::Ones()};
    PolygonMesh mesh;
    Vertices<Cell> vertices;
    for_each_cell(0, n, [&](const Cell& cell) {
        if (!lattice.has(cell))
            return;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const Index side : {0, 1}) {
                Cell neighbour = cell;
                neighbour[axis] += 2 * side - 1;
                if (lattice.has(neighbour))
                    continue;
                std::vector<Index> face;
                for (const Cell& corner : face_of_cube(axis, side)) {
                    const Cell at = plus(cell, corner);
                    face.push_back(vertices.number_of(at, lattice.place(at) - Point::Constant(0.5)));
                }
                mesh.add_face(face);
            }
    });
    mesh.vertices = vertices.points();
    return mesh;
}

PolygonMesh wall_faces(const Materials& material, Index n)
{
    const Inside everywhere = [](const Point&) { return true; };
    const Lattice lattice{everywhere, n, Point::Ones()};
    const auto material_of = [&](const Cell& cell) { return lattice.has(cell) ? material(lattice.place(cell)) : 0; };
    PolygonMesh mesh;
    Vertices<Cell> vertices;
    for_each_cell(-1, n, [&](const Cell& cell) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Cell next = cell;
            ++next[axis];
            if (material_of(cell) == material_of(next))
                continue;
            std::vector<Index> face;
            for (const Cell& corner : face_of_cube(axis, 1)) {
                const Cell at = plus(cell, corner);
                face.push_back(vertices.number_of(at, lattice.place(at) - Point::Constant(0.5)));
            }
            mesh.add_face(face);
        }
    });
    mesh.vertices = vertices.points();
    return mesh;
}

PolygonMesh crossed_edges(const Inside& inside, Index n, const Point& spacing)
{
    const Lattice lattice{inside, n, spacing};
    PolygonMesh mesh;
    Vertices<std::array<Index, 4>> vertices;
    for_each_cell(-1, n, [&](const Cell& cube) { add_polygons(lattice, cube, vertices, mesh); });
    mesh.vertices = vertices.points();
    return mesh;
}

PolygonMesh height_grid(Index n, const std::function<double(double x, double y)>& height)
{
    PolygonMesh mesh;
    mesh.vertices.resize(n * n, 3);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
            const Index v = j * n + i;
            mesh.vertices.row(v) = Point(i, j, height(i, j));
            if (i + 1 == n || j + 1 == n)
                continue;
            mesh.add_face(std::array{v, v + 1, v + n + 1});
            mesh.add_face(std::array{v, v + n + 1, v + n});
        }
    return mesh;
}

PolygonMesh rounded(PolygonMesh mesh, const Point& steps)
{
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            if (steps[axis] > 0.0)
                mesh.vertices(v, axis) = std::round(mesh.vertices(v, axis) / steps[axis]) * steps[axis];
    return mesh;
}

Inside ball(double radius)
{
    return [radius](const Point& point) { return point.norm() < radius; };
}

Inside stepped_pyramid(double height, double depth)
{
    return [=](const Point& point) {
        constexpr double foot = 12.0;
        const double storey = std::floor((point.z() + foot) / height);
        return storey >= 0.0 && std::max(std::abs(point.x()), std::abs(point.y())) < foot - depth * storey;
    };
}

}  // namespace seamflow::test
