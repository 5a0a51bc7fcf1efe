#include "tests/support/junction_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "samples/meshes/random_numbers.h"

namespace seamflow::test {

PolygonMesh plates(std::span<const double> angles, Index m, Index n)
{
    PolygonMesh mesh;
    mesh.vertices.resize((n + 1) * (1 + static_cast<Index>(angles.size()) * m), 3);
    for (Index j = 0; j <= n; ++j)
        mesh.vertices.row(j) << 0, 0, j;
    Index first = n + 1;
    for (const double angle : angles) {
        const auto vertex = [&](Index i, Index j) { return i == 0 ? j : first + (i - 1) * (n + 1) + j; };
        for (Index i = 1; i <= m; ++i)
            for (Index j = 0; j <= n; ++j)
                mesh.vertices.row(vertex(i, j)) << i * std::cos(angle), i * std::sin(angle), j;
        for (Index i = 0; i < m; ++i)
            for (Index j = 0; j < n; ++j)
                mesh.add_face(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        first += m * (n + 1);
    }
    return mesh;
}

PolygonMesh faces_between(Index size, const std::function<int(const Point&)>& label)
{
    const auto label_of = [&](const std::array<Index, 3>& cube) {
        for (const Index i : cube)
            if (i < 0 || i >= size)
                return -1;
        return label(Point(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5));
    };
    PolygonMesh mesh;
    std::vector<Point> positions;
    std::vector<Index> number((size + 1) * (size + 1) * (size + 1), -1);
    const auto vertex = [&](const std::array<Index, 3>& at_corner) {
        Index& v = number[(at_corner[0] * (size + 1) + at_corner[1]) * (size + 1) + at_corner[2]];
        if (v < 0) {
            v = static_cast<Index>(positions.size());
            positions.emplace_back(at_corner[0], at_corner[1], at_corner[2]);
        }
        return v;
    };
    const auto add_between = [&](const std::array<Index, 3>& cube, std::size_t axis) {
        std::array<Index, 3> below = cube;
        --below[axis];
        const int one = label_of(below);
        const int other = label_of(cube);
        if (one == other || one < 0 || other < 0)
            return;
        std::array corner{cube, cube, cube, cube};
        ++corner[1][(axis + 1) % 3];
        ++corner[2][(axis + 1) % 3];
        ++corner[2][(axis + 2) % 3];
        ++corner[3][(axis + 2) % 3];
        std::array<Index, 4> face{};
        for (std::size_t k = 0; k < 4; ++k)
            face[one < other ? k : 3 - k] = vertex(corner[k]);
        mesh.add_face(face);
    };
    for (Index i = 0; i < size; ++i)
        for (Index j = 0; j < size; ++j)
            for (Index k = 0; k < size; ++k)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    add_between({i, j, k}, axis);
    mesh.vertices.resize(static_cast<Index>(positions.size()), 3);
    for (std::size_t v = 0; v < positions.size(); ++v)
        mesh.vertices.row(static_cast<Index>(v)) = positions[v];
    return mesh;
}

PolygonMesh foam(Index size, int n_seeds, std::uint32_t seed)
{
    RandomNumbers random(seed);
    const auto number = [&] { return size * (0.5 + 0.4 * random.symmetric()); };
    std::vector<Point> seeds;
    for (int i = 0; i < n_seeds; ++i) {
        const double x = number();
        const double y = number();
        seeds.emplace_back(x, y, number());
    }
    return faces_between(size, [&](const Point& point) {
        if ((point.array() < 1.0).any() || (point.array() > size - 1.0).any())
            return 0;
        int nearest = 0;
        for (int i = 1; i < n_seeds; ++i)
            if ((point - seeds[static_cast<std::size_t>(i)]).squaredNorm() <
                (point - seeds[static_cast<std::size_t>(nearest)]).squaredNorm())
                nearest = i;
        return nearest + 1;
    });
}

PolygonMesh touching_balls(Index size)
{
    const Point middle = Point::Constant(0.5 * size);
    const double radius = 0.24 * size;
    const Point apart(0.0, 0.0, 0.75 * radius);
    return faces_between(size, [&](const Point& point) {
        const double below = (point - middle + apart).norm();
        const double above = (point - middle - apart).norm();
        return std::min(below, above) < radius ? (below < above ? 1 : 2) : 0;
    });
}

PolygonMesh cut_into_triangles(const PolygonMesh& quads)
{
    PolygonMesh mesh;
    mesh.vertices = quads.vertices;
    for (Index f = 0; f < quads.n_faces(); ++f) {
        const auto q = quads.face(f);
        mesh.add_face(std::array{q[0], q[1], q[2]});
        mesh.add_face(std::array{q[0], q[2], q[3]});
    }
    return mesh;
}

}  // namespace seamflow::test
