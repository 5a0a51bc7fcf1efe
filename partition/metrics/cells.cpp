#include "partition/metrics/cells.h"

#include <algorithm>
#include <functional>

#include "partition/metrics/regions.h"

namespace seamflow {

EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const Regions regions = find_regions(mesh, positions, exec);
    std::vector<Index> largest_first = select(exec, regions.count(), [&](Index r) { return regions.volumes[r] > 0.0; });
    std::ranges::stable_sort(largest_first, std::greater<>(), [&](Index r) { return regions.volumes[r]; });
    EnclosedCells cells;
    for (const Index r : largest_first) {
        cells.sides.values.insert(cells.sides.values.end(), regions.sides[r].begin(), regions.sides[r].end());
        cells.sides.close();
    }
    cells.n_surfaces = static_cast<Index>(std::ranges::count_if(regions.volumes, [](double v) { return v < 0.0; }));
    cells.n_overlaps = static_cast<Index>(std::ranges::count_if(
        regions.contacts, [&](Index side) { return regions.volumes[regions.of_side[side]] != 0.0; }));
    return cells;
}

std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec)
{
    return volumes_on(cells.sides, mesh, positions, exec);
}

}  // namespace seamflow
