#include "solvers/rounding/common_drift.h"

#include <cmath>
#include <utility>
#include <vector>

#include "partition/metrics/vertex_normals.h"

namespace seamflow {

namespace {

/// The normals of the vertices that move, 0 for the others.
Points normals_of_moving(const PolygonMesh& mesh, const Topology& topology, const Boxes& boxes, const Points& positions,
                         const Executor& exec)
{
    const VertexNormals normal(mesh, topology);
    Points normals(positions.rows(), 3);
    for_each(exec, static_cast<Index>(positions.rows()), [&](Index v) {
        normals.row(v) = boxes.half_widths.row(v).isZero(0.0) ? Point(Point::Zero()) : normal(v, positions);
    });
    return normals;
}

/// Replaces each height, several times, by the mean of itself and the mean of its neighbours. Heights change sides
/// where normals do: faces need not be oriented alike. Neighbours without a normal count as 0.
void average(const IndexLists& neighbours, const Points& normals, int rounds, std::vector<double>& heights,
             const Executor& exec)
{
    std::vector<double> means(heights.size());
    for (int round = 0; round < rounds; ++round) {
        for_each(exec, static_cast<Index>(heights.size()), [&](Index v) {
            double total = 0.0;
            for (const Index w : neighbours[v])
                if (const double cosine = normals.row(v).dot(normals.row(w)); cosine != 0.0)
                    total += cosine > 0.0 ? heights[w] : -heights[w];
            const auto n = static_cast<double>(neighbours[v].size());
            means[v] = n > 0.0 ? 0.5 * (heights[v] + total / n) : heights[v];
        });
        heights.swap(means);
    }
}

}  // namespace

std::vector<Index> take_back_drift(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                                   const Boxes& boxes, int rounds, double by_chance, Points& positions,
                                   const Executor& exec)
{
    const Points normals = normals_of_moving(mesh, topology, boxes, positions, exec);
    std::vector<double> drift(static_cast<std::size_t>(positions.rows()));
    for_each(exec, static_cast<Index>(positions.rows()),
             [&](Index v) { drift[v] = normals.row(v).dot(boxes.middles.row(v) - positions.row(v)); });
    average(neighbours, normals, rounds, drift, exec);
    std::vector<Index> drifted = select(exec, static_cast<Index>(positions.rows()), [&](Index v) {
        return std::abs(drift[v]) > by_chance && !normals.row(v).isZero(0.0);
    });
    for_each(exec, static_cast<Index>(drifted.size()), [&](Index i) {
        const Index v = drifted[usize(i)];
        const double chance = by_chance / drift[v];
        const Point back = (1.0 - chance * chance) * drift[v] * normals.row(v);
        positions.row(v) = boxes.nearest(v, positions.row(v) + back);
    });
    return drifted;
}

}  // namespace seamflow
