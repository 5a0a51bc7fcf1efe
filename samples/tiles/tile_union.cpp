#include "samples/tiles/tile_union.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seamflow {

namespace {

/// Cells on each side that are in the neighbourhood of a cell with a point.
constexpr int n_cells_around = 2;

std::uint64_t key_of(Index tile, Index vertex)
{
    return static_cast<std::uint64_t>(tile) << 32U | static_cast<std::uint64_t>(vertex);
}

std::span<const Index> face_of(const TileFaces& faces, std::size_t f)
{
    const std::size_t begin = usize(faces.face_offsets[f]);
    return std::span<const Index>(faces.face_vertices).subspan(begin, usize(faces.face_offsets[f + 1]) - begin);
}

}  // namespace

bool meet(const BoundingBox& a, const BoundingBox& b)
{
    return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

BoundingBox box_around(const Points& positions)
{
    if (positions.rows() == 0)
        return {};
    return {positions.colwise().minCoeff(), positions.colwise().maxCoeff()};
}

BoundingBox inflated(const BoundingBox& box, double length)
{
    return {box.low.array() - length, box.high.array() + length};
}

Neighbourhood::Neighbourhood(const Points& points, double width)
    : cell_(width / n_cells_around)
    , box_(inflated(box_around(points), width))
{
    PointNumbers occupied;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        occupied(cell_at(points.row(i)));
    constexpr int n = 2 * n_cells_around + 1;
    for (const auto& [x, y, z] : occupied.points())
        for (int i = 0; i < n * n * n; ++i)
            cells_({x + i % n - n_cells_around, y + i / n % n - n_cells_around, z + i / (n * n) - n_cells_around});
}

PointNumbers::Place Neighbourhood::cell_at(const Point& point) const
{
    return {std::floor(point[0] / cell_), std::floor(point[1] / cell_), std::floor(point[2] / cell_)};
}

bool Neighbourhood::contains(const Point& point) const
{
    return !is_empty() && meet(box_, {point, point}) && cells_.find(cell_at(point)) >= 0;
}

std::vector<std::uint8_t> Neighbourhood::select(const Points& positions, const Executor& exec) const
{
    std::vector<std::uint8_t> is_near(static_cast<std::size_t>(positions.rows()), 0);
    for_each(exec, static_cast<Index>(positions.rows()),
             [&](Index v) { is_near[v] = contains(positions.row(v)) ? 1 : 0; });
    return is_near;
}

std::vector<Index> TileUnion::add(const TileFaces& faces, const TileOwners& owners, const Points& positions,
                                  std::span<const std::uint8_t> is_wanted)
{
    const auto is_wanted_vertex = [&](Index v) { return is_wanted[usize(v)] != 0; };
    std::vector<std::size_t> taken;
    std::vector<Index> used(is_wanted.size(), 0);
    for (std::size_t f = 0; f + 1 < faces.face_offsets.size(); ++f) {
        const auto corners = face_of(faces, f);
        if (std::ranges::none_of(corners, is_wanted_vertex))
            continue;
        taken.push_back(f);
        for (const Index v : corners)
            used[v] = 1;
    }
    std::vector<Index> number_of = number(used, owners, positions);
    for (const std::size_t f : taken) {
        for (const Index v : face_of(faces, f))
            mesh_.face_vertices.push_back(number_of[v]);
        mesh_.face_offsets.push_back(mesh_.n_corners());
    }
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v] != 0 && is_wanted[v] == 0)
            held_.push_back(number_of[v]);
    for (const Index v : owners.held)
        if (used[v] != 0)
            held_.push_back(number_of[v]);
    return number_of;
}

std::vector<Index> TileUnion::number(const std::vector<Index>& used, const TileOwners& owners, const Points& positions)
{
    std::vector<Index> number_of(used.size(), -1);
    Index n = mesh_.n_vertices();
    mesh_.vertices.conservativeResize(n + std::count(used.begin(), used.end(), 1), 3);
    std::size_t next_on_border = 0;
    for (std::size_t v = 0; v < used.size(); ++v) {
        const bool is_on_border =
            next_on_border < owners.vertices.size() && usize(owners.vertices[next_on_border]) == v;
        const std::size_t i = next_on_border;
        next_on_border += is_on_border ? 1 : 0;
        if (used[v] == 0)
            continue;
        if (is_on_border) {
            const auto [place, is_new] = number_of_owner_.try_emplace(key_of(owners.tiles[i], owners.numbers[i]), n);
            number_of[v] = place->second;
            if (!is_new)
                continue;
        }
        number_of[v] = n;
        mesh_.vertices.row(n++) = positions.row(static_cast<Eigen::Index>(v));
    }
    mesh_.vertices.conservativeResize(n, 3);
    return number_of;
}

}  // namespace seamflow
