#include "partition/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "partition/index_lists.h"
#include "partition/point_numbers.h"
#include "partition/vector_area.h"
#include "partition/weld.h"

namespace seamflow {

namespace {

/// Two boundary vertices are near each other if their distance is within this fraction of the median boundary edge.
constexpr double near_in_edges = 0.01;
/// The distance for weld, in crack widths: if the corners of several faces should be one point, the outer ones are
/// further apart than nearest neighbours, by about this factor.
constexpr double apart_in_widths = 2.0;

/// The median of the finite lengths of all edges without a twin (those of one face, or of three or more); 0 if there
/// are none.
double median_boundary_edge(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const auto halfedges = select(exec, mesh.n_corners(), [&](Index h) { return topology.twin[h] < 0; });
    std::vector<double> lengths;
    for (const Index h : halfedges)
        lengths.push_back(edge_length(mesh, topology, h));
    std::erase_if(lengths, [](double length) { return !std::isfinite(length); });
    if (lengths.empty())
        return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/// For each point the distance to the nearest point at another position; infinite if that is beyond `reach`, or if the
/// cells around the point have too many points to compare.
std::vector<double> distances_of_nearest(const std::vector<Point>& points, double reach, const Executor& exec)
{
    // Points in a cell of more points than this are too many to be corners of one point: they are not compared.
    constexpr Index most_in_cell = 64;
    // The cell of a point and the cells around it.
    constexpr int n_around = 27;
    const auto cell_at = [&](const Point& p) {
        return PointNumbers::Place{std::floor(p[0] / reach), std::floor(p[1] / reach), std::floor(p[2] / reach)};
    };
    PointNumbers cells;
    std::vector<Index> cell_of;
    for (const Point& p : points)
        cell_of.push_back(cells(cell_at(p)));
    const IndexLists in_cell = make_lists(static_cast<Index>(cells.points().size()), [&](auto&& add) {
        for (std::size_t i = 0; i < cell_of.size(); ++i)
            add(cell_of[i], static_cast<Index>(i));
    });
    std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
    for_each(exec, static_cast<Index>(points.size()), [&](Index i) {
        const PointNumbers::Place cell = cells.points()[cell_of[i]];
        for (int k = 0; k < n_around; ++k) {
            const Index c = cells.find({cell[0] + k / 9 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k % 3 - 1});
            if (c < 0 || in_cell[c].size() > most_in_cell)
                continue;
            for (const Index other : in_cell[c])
                if (const double distance = (points[other] - points[i]).norm(); distance > 0.0 && distance <= reach)
                    nearest[i] = std::min(nearest[i], distance);
        }
    });
    return nearest;
}

/// Rounds a positive number up to one significant digit.
double rounded_up(double value)
{
    const double unit = std::pow(10.0, std::floor(std::log10(value)));
    return std::ceil(value / unit) * unit;
}

}  // namespace

std::optional<Cracks> find_cracks(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const auto vertices = select(exec, mesh.n_vertices(), [&](Index v) {
        return topology.kind[v] == VertexKind::Boundary && mesh.vertices.row(v).allFinite();
    });
    const double reach = vertices.empty() ? 0.0 : near_in_edges * median_boundary_edge(mesh, topology, exec);
    if (!std::isnormal(reach))
        return {};
    std::vector<Point> points;
    for (const Index v : vertices)
        points.emplace_back(mesh.vertices.row(v));
    Cracks cracks;
    for (const double distance : distances_of_nearest(points, reach, exec))
        if (std::isfinite(distance)) {
            ++cracks.n_vertices;
            cracks.width = std::max(cracks.width, distance);
        }
    if (cracks.n_vertices == 0)
        return {};
    cracks.weld_distance = rounded_up(apart_in_widths * cracks.width);
    const std::optional<Weld> welded = weld(mesh, topology, cracks.weld_distance, exec);
    if (!welded)
        return {};
    cracks.n_edges = welded->n_edges;
    return cracks;
}

Remark remark_on_cracks(const Cracks& cracks)
{
    return {"cracks",
            {{"vertices", cracks.n_vertices},
             {"width", cracks.width},
             {"weld", cracks.weld_distance},
             {"pairs of edges", cracks.n_edges}},
            {fmt::format("{} boundary vertices lie within {:.2g} of others, but not on them, as along cracks: "
                         "<weld {:g}> joins {} of boundary edges there.",
                         cracks.n_vertices, cracks.width, cracks.weld_distance,
                         cracks.n_edges == 1 ? "1 pair" : fmt::format("{} pairs", cracks.n_edges))}};
}

}  // namespace seamflow
