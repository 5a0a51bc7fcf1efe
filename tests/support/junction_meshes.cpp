#include "tests/support/junction_meshes.h"

#include <array>
#include <cmath>
#include <vector>

#include "samples/meshes/label_surfaces.h"

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

namespace {

PolygonMesh scaled_faces_between(Index size, const Labels& of_unit_cube)
{
    return faces_between(size, [&](const Point& point) { return of_unit_cube(point / size); }).mesh;
}

}  // namespace

PolygonMesh foam(Index size, int n_seeds, std::uint32_t seed)
{
    return scaled_faces_between(size, foam_of(n_seeds, seed));
}

PolygonMesh touching_balls(Index size)
{
    return scaled_faces_between(size, two_balls());
}

PolygonMesh cut_into_triangles(const PolygonMesh& quads)
{
    const std::vector<Index> none(usize(quads.n_faces()));
    return seamflow::cut_into_triangles({quads, none, none}).mesh;
}

}  // namespace seamflow::test
