#include "partition/metrics/cells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "partition/disjoint_sets.h"
#include "partition/metrics/sheet_order.h"
#include "partition/metrics/volume.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The regions into which the faces of a mesh divide space, found by walking around edges: from the side of a face to
/// the side of the next face that faces it, and at an edge of one face to the other side of the face. Sides are
/// numbered 2 f for the side of face f to which its normal points, and 2 f + 1 for the other, so that side ^ 1 is the
/// opposite side of the same face. A region is bounded by one connected surface: the space between the two surfaces of
/// a hollow body counts as two regions here. A sheet is a part of the mesh without edges of three faces or more; sheets
/// meet at such edges.
struct Regions {
    /// #2F: the region at each side, numbered by their lowest sides.
    std::vector<Index> of_side;
    /// The sides of each region, ascending. Faces with both sides in one region are left out.
    IndexLists sides;
    /// In length³: positive if the region lies within its surface, negative if it lies around it, 0 if the volume may
    /// be rounding of positions in single precision, as between repeated faces.
    std::vector<double> volumes;
    /// The contacts, at edges where sheets meet: the sides of faces on which the next face around the edge lies. The
    /// region at such a side is the one between the two faces. If two sheets lie on each other with the same faces,
    /// nothing is between them: the region has the volume 0.
    std::vector<Index> contacts;
};

/// Joins the sides that face each other across the half-edges of a face, except where sheets meet.
void join_at_face(const PolygonMesh& mesh, const Topology& topology, Index f, DisjointSets& sides)
{
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
        const Index twin = topology.twin[h];
        if (twin > h) {
            // The side of the neighbour that faces side 2 f.
            const Index front =
                2 * topology.face_of[twin] + (mesh.face_vertices[twin] == mesh.face_vertices[h] ? 1 : 0);
            sides.join(2 * f, front);
            sides.join(2 * f + 1, front ^ 1);
        } else if (twin < 0 && topology.junction_index(h) < 0) {
            sides.join(2 * f, 2 * f + 1);
        }
    }
}

/// Joins the sides that face each other around the edge of half-edge h, where sheets meet.
/// @param contacts receives the sides of faces on which the next face lies.
void join_around(const SheetOrder& order, const Topology& topology, Index h, DisjointSets& sides,
                 std::vector<Index>& contacts)
{
    // The front of a face is the side towards which angles around its own half-edge grow.
    const auto side_forwards = [&](Index other) {
        return 2 * topology.face_of[other] + (order.runs_up(other) ? 0 : 1);
    };
    const std::vector<SheetSpoke> spokes = order.around(h);
    for (std::size_t i = 0; i < spokes.size(); ++i) {
        const Index side = side_forwards(spokes[i > 0 ? i - 1 : spokes.size() - 1].halfedge);
        sides.join(side, side_forwards(spokes[i].halfedge) ^ 1);
        if (spokes[i].lies_on_previous)
            contacts.push_back(side);
    }
}

/// Calls value(list, exec) for each list, for long ones with an executor that has threads.
template <class Value>
std::vector<double> of_lists(const IndexLists& lists, const Executor& exec, Value&& value)
{
    std::vector<double> values(usize(lists.size()));
    const auto is_long = [&](Index list) { return std::ssize(lists[list]) > block_size; };
    for_each(exec, lists.size(), [&](Index list) {
        if (!is_long(list))
            values[list] = value(lists[list], run_serially);
    });
    for (Index list = 0; list < lists.size(); ++list)
        if (is_long(list))
            values[list] = value(lists[list], exec);
    return values;
}

/// The volume of the region with these sides, in length³; its sign as in Regions::volumes. It is the sum of the signed
/// volumes of the cones from one point to all faces.
double volume_on(std::span<const Index> sides, const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    if (sides.empty())
        return 0.0;
    const Point origin = positions.row(mesh.face(sides[0] / 2).front());
    return sum(exec, static_cast<Index>(sides.size()), [&](Index i) {
        const double cone = cone_volume(mesh.face(sides[i] / 2), positions, origin);
        return sides[i] % 2 == 0 ? -cone : cone;
    });
}

/// The volume of the region with these sides (see volume_on); 0 if it may be rounding of positions in single precision.
double certain_volume_on(std::span<const Index> sides, const PolygonMesh& mesh, const Points& positions,
                         const Executor& exec)
{
    const double volume = volume_on(sides, mesh, positions, exec);
    const double area = sum(exec, static_cast<Index>(sides.size()),
                            [&](Index i) { return vector_area(mesh.face(sides[i] / 2), positions).stableNorm(); });
    // Positions in single precision have errors of about this fraction of the size of a region.
    constexpr double rounding = 1e-7;
    return std::abs(volume) > rounding * area * std::sqrt(area) ? volume : 0.0;
}

/// The sides of each region. Faces with both sides in one region are left out.
IndexLists sides_of(const std::vector<Index>& region_of, Index n_regions)
{
    return make_lists(n_regions, [&](auto&& add) {
        for (Index side = 0; side < std::ssize(region_of); ++side)
            if (region_of[side] != region_of[side ^ 1])
                add(region_of[side], side);
    });
}

/// The regions into which the faces at given positions divide space.
Regions find_regions(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    Topology topology = make_topology(mesh, exec);
    free_junctions(mesh, topology, exec);
    const SheetOrder order(mesh, positions, topology);
    DisjointSets sides(2 * mesh.n_faces(), exec);
    for_each(exec, mesh.n_faces(), [&](Index f) { join_at_face(mesh, topology, f, sides); });
    Regions regions;
    regions.contacts = reduce(
        exec, static_cast<Index>(topology.junctions.size()), std::vector<Index>{},
        [&](std::vector<Index>& contacts, Index i) {
            // The highest half-edge at an edge leads back to the lowest.
            if (const JunctionLink& link = topology.junctions[i]; link.next < link.halfedge)
                join_around(order, topology, link.halfedge, sides, contacts);
        },
        [](auto& all, const auto& part) { all.insert(all.end(), part.begin(), part.end()); });
    auto [of_side, n_regions] = sides.numbered(exec);
    regions.sides = sides_of(of_side, n_regions);
    regions.of_side = std::move(of_side);
    regions.volumes = of_lists(regions.sides, exec, [&](std::span<const Index> list, const Executor& inner) {
        return certain_volume_on(list, mesh, positions, inner);
    });
    return regions;
}

}  // namespace

EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const Regions regions = find_regions(mesh, positions, exec);
    std::vector<Index> largest_first =
        select(exec, regions.sides.size(), [&](Index r) { return regions.volumes[r] > 0.0; });
    std::ranges::stable_sort(largest_first, std::greater<>(), [&](Index r) { return regions.volumes[r]; });
    EnclosedCells cells;
    for (const Index r : largest_first) {
        cells.sides.values.insert(cells.sides.values.end(), regions.sides[r].begin(), regions.sides[r].end());
        cells.sides.close();
    }
    // Each connected surface has one region around it.
    cells.n_surfaces =
        static_cast<Index>(std::ranges::count_if(regions.volumes, [](double volume) { return volume < 0.0; }));
    // Two faces that lie on each other should have nothing between them. If the region between them has a volume, the
    // two sheets have different faces, so that walking from one to the other has led into a cell or the outside.
    cells.n_overlaps = static_cast<Index>(std::ranges::count_if(
        regions.contacts, [&](Index side) { return regions.volumes[regions.of_side[side]] != 0.0; }));
    return cells;
}

std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec)
{
    return of_lists(cells.sides, exec, [&](std::span<const Index> list, const Executor& inner) {
        return volume_on(list, mesh, positions, inner);
    });
}

}  // namespace seamflow
