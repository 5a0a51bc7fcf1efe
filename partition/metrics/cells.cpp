#include "partition/metrics/cells.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "partition/metrics/nested_cells.h"
#include "partition/metrics/regions.h"

namespace seamflow {

namespace {

/// For each region that is within a surface, itself and the regions around the surfaces in it.
IndexLists parts_of_cells(const Regions& regions, const std::vector<Index>& cell_around)
{
    return make_lists(regions.count(), [&](auto&& add) {
        for (Index r = 0; r < regions.count(); ++r)
            if (regions.volumes[r] > 0.0)
                add(r, r);
        for (Index r = 0; r < regions.count(); ++r)
            if (cell_around[r] >= 0)
                add(cell_around[r], r);
    });
}

}  // namespace

EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const Regions regions = find_regions(mesh, positions, exec);
    const IndexLists parts = parts_of_cells(regions, containing_cells(mesh, positions, regions, exec));
    std::vector<Index> largest_first = select(exec, regions.count(), [&](Index r) { return !parts[r].empty(); });
    std::ranges::stable_sort(largest_first, std::greater<>(), [&](Index r) {
        return std::accumulate(parts[r].begin(), parts[r].end(), 0.0,
                               [&](double volume, Index part) { return volume + regions.volumes[part]; });
    });
    EnclosedCells cells;
    for (const Index r : largest_first) {
        for (const Index part : parts[r])
            cells.sides.values.insert(cells.sides.values.end(), regions.sides[part].begin(), regions.sides[part].end());
        cells.sides.close();
    }
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
