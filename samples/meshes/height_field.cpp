#include "samples/meshes/height_field.h"

#include <cmath>
#include <numbers>

#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

std::size_t n_cells(const Grid& grid)
{
    return static_cast<std::size_t>(grid.columns - 1) * static_cast<std::size_t>(grid.rows - 1);
}

/// y of a vertex of a honeycomb, in rows. Where column + row is even, an edge leads upwards, else downwards.
double zigzag(const Grid& grid, Index column, Index row)
{
    if (row == 0 || row == grid.rows - 1)
        return row;
    return row + ((column + row) % 2 == 0 ? 1.0 : -1.0) / 6.0;
}

/// The faces between two rows of a honeycomb: vertical edges bound them at every second column, and at both ends.
void add_honeycomb_row(PolygonMesh& mesh, const Grid& grid, Index row)
{
    const Index last = grid.columns - 1;
    const auto low = [&](Index column) { return grid.vertex(column, row); };
    const auto high = [&](Index column) { return grid.vertex(column, row + 1); };
    for (Index i = row % 2 == 0 ? 0 : -1; i < last; i += 2) {
        if (i < 0)
            add_face(mesh, {low(0), low(1), high(1), high(0)});
        else if (i + 1 == last)
            add_face(mesh, {low(i), low(last), high(last), high(i)});
        else
            add_face(mesh, {low(i), low(i + 1), low(i + 2), high(i + 2), high(i + 1), high(i)});
    }
}

}  // namespace

void require_valid(const HeightFieldShape& shape)
{
    require_between("amplitude", shape.amplitude, -1e6, 1e6);
    require_between("waves", shape.waves, 0, 1e6);
    require_between("noise", shape.noise, 0, 1e6);
}

void raise(PolygonMesh& mesh, const Grid& grid, const HeightFieldShape& shape)
{
    RandomNumbers random(shape.seed);
    const double frequency = 2.0 * std::numbers::pi * shape.waves;
    const double displacement = shape.noise / std::sqrt(static_cast<double>(grid.size()));
    for (Index row = 0; row < grid.rows; ++row)
        for (Index column = 0; column < grid.columns; ++column) {
            auto p = mesh.vertices.row(grid.vertex(column, row));
            p.z() = shape.amplitude * std::cos(frequency * p.x()) * std::cos(frequency * p.y());
            if (!grid.on_border(column, row))
                p.z() += displacement * random.symmetric();
        }
}

PolygonMesh flat_grid(const Grid& grid, std::size_t corners, std::size_t faces)
{
    PolygonMesh mesh = mesh_with_room(grid.size(), corners, faces);
    for (Index row = 0; row < grid.rows; ++row)
        for (Index column = 0; column < grid.columns; ++column)
            mesh.vertices.row(grid.vertex(column, row)) << static_cast<double>(column) / (grid.columns - 1),
                static_cast<double>(row) / (grid.rows - 1), 0.0;
    return mesh;
}

PolygonMesh make_triangles(Index vertices, const HeightFieldShape& shape)
{
    require_vertices(vertices);
    require_valid(shape);
    const Grid grid = grid_of(vertices, 1.0);
    PolygonMesh mesh = flat_grid(grid, 6 * n_cells(grid), 2 * n_cells(grid));
    for (Index j = 0; j + 1 < grid.rows; ++j)
        for (Index i = 0; i + 1 < grid.columns; ++i) {
            add_face(mesh, {grid.vertex(i, j), grid.vertex(i + 1, j), grid.vertex(i + 1, j + 1)});
            add_face(mesh, {grid.vertex(i, j), grid.vertex(i + 1, j + 1), grid.vertex(i, j + 1)});
        }
    raise(mesh, grid, shape);
    return mesh;
}

PolygonMesh make_quads(Index vertices, const HeightFieldShape& shape)
{
    require_vertices(vertices);
    require_valid(shape);
    const Grid grid = grid_of(vertices, 1.0);
    PolygonMesh mesh = flat_grid(grid, 4 * n_cells(grid), n_cells(grid));
    for (Index j = 0; j + 1 < grid.rows; ++j)
        for (Index i = 0; i + 1 < grid.columns; ++i)
            add_face(mesh,
                     {grid.vertex(i, j), grid.vertex(i + 1, j), grid.vertex(i + 1, j + 1), grid.vertex(i, j + 1)});
    raise(mesh, grid, shape);
    return mesh;
}

PolygonMesh make_hexagons(Index vertices, const HeightFieldShape& shape)
{
    require_vertices(vertices);
    require_valid(shape);
    // A regular hexagon of edge a is two columns of a √3 / 2 wide, and its rows are 3 a / 2 apart.
    const Grid grid = grid_of(vertices, std::numbers::sqrt3);
    PolygonMesh mesh = flat_grid(grid, 3 * n_cells(grid) + 2 * static_cast<std::size_t>(grid.rows), n_cells(grid));
    for (Index j = 0; j < grid.rows; ++j)
        for (Index i = 0; i < grid.columns; ++i)
            mesh.vertices(grid.vertex(i, j), 1) = zigzag(grid, i, j) / (grid.rows - 1);
    for (Index j = 0; j + 1 < grid.rows; ++j)
        add_honeycomb_row(mesh, grid, j);
    raise(mesh, grid, shape);
    return mesh;
}

}  // namespace seamflow
