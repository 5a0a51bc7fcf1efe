#include "partition/metrics/cells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "partition/connected_components.h"
#include "partition/metrics/volume.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// Of length 1; 0 for a vector without length or too long for a double.
Point direction_of(const Point& vector)
{
    return vector.allFinite() ? vector.stableNormalized() : Point(Point::Zero());
}

/// A half-edge at a junction and its angle about the edge.
struct Spoke {
    double angle;
    Index halfedge;
    friend auto operator<=>(const Spoke&, const Spoke&) = default;
};

/// The half-edges around the edges where sheets meet, in the order of the angles of their faces.
class SheetOrder {
  public:
    SheetOrder(const PolygonMesh& mesh, const Points& positions, const Topology& topology, const Executor& exec)
        : mesh_(mesh)
        , positions_(positions)
        , topology_(topology)
        , forwards_(topology.junctions.size())
        , backwards_(topology.junctions.size())
    {
        for_each(exec, static_cast<Index>(topology.junctions.size()), [&](Index i) {
            // The highest half-edge at an edge leads back to the lowest.
            if (const auto& [halfedge, next] = topology.junctions[i]; next < halfedge)
                link(sorted_around(halfedge));
        });
    }

    /// Whether half-edge h runs from the lower to the higher vertex. Angles are counterclockwise about this direction.
    [[nodiscard]] bool runs_up(Index h) const
    {
        return mesh_.face_vertices[h] < mesh_.face_vertices[topology_.next(mesh_, h)];
    }

    /// Calls visit with the sides of faces next to a side, around each of its edges.
    template <class Visit>
    void for_each_neighbour_of(Index side, Visit&& visit) const
    {
        const bool is_front = side % 2 == 0;
        for (Index h = mesh_.face_offsets[side / 2]; h < mesh_.face_offsets[side / 2 + 1]; ++h) {
            // The front of a face is where angles about its own half-edge grow.
            const bool is_forwards = is_front == runs_up(h);
            const Index other = next_around(h, is_forwards);
            visit(2 * topology_.face_of[other] + (is_forwards == runs_up(other) ? 1 : 0));
        }
    }

  private:
    [[nodiscard]] Index next_around(Index h, bool is_forwards) const
    {
        if (topology_.twin[h] >= 0)
            return topology_.twin[h];
        const Index place = place_of(h);
        return place < 0 ? h : (is_forwards ? forwards_ : backwards_)[place];
    }

    /// In the list of junctions, or -1.
    [[nodiscard]] Index place_of(Index h) const
    {
        const auto found = std::ranges::lower_bound(topology_.junctions, h, {}, &JunctionLink::halfedge);
        return found != topology_.junctions.end() && found->halfedge == h
                   ? static_cast<Index>(found - topology_.junctions.begin())
                   : -1;
    }

    /// The direction from an edge into the face of half-edge h, upright on the edge. Its bits depend neither on the
    /// first corner of the face nor on its sense, so that repeated faces have the same.
    [[nodiscard]] Point into_face(Index h, const Point& axis) const
    {
        const auto face = mesh_.face(topology_.face_of[h]);
        std::vector<Index> corners(face.begin(), face.end());
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        bool is_along = runs_up(h);
        if (corners[1] > corners.back()) {
            std::reverse(corners.begin() + 1, corners.end());
            is_along = !is_along;
        }
        const Point inwards = direction_of(vector_area(corners, positions_).cross(axis));
        return is_along ? inwards : Point(-inwards);
    }

    /// All half-edges at the edge of h. Where angles are equal, that of the lowest number comes first, seen along it.
    [[nodiscard]] std::vector<Spoke> sorted_around(Index h) const
    {
        const auto [lower, higher] = std::minmax(mesh_.face_vertices[h], mesh_.face_vertices[topology_.next(mesh_, h)]);
        const Point axis = direction_of(positions_.row(higher) - positions_.row(lower));
        std::vector<Spoke> spokes;
        Point first = Point::Zero();
        for (Index other = topology_.next_at_junction(h);; other = topology_.next_at_junction(other)) {
            const Point direction = into_face(other, axis);
            if (first.isZero(0.0))
                first = direction;
            spokes.push_back({std::atan2(direction.dot(axis.cross(first)), direction.dot(first)), other});
            if (other == h)
                break;
        }
        std::ranges::sort(spokes);
        for (auto begin = spokes.begin(); begin != spokes.end();) {
            const auto end = std::find_if(begin, spokes.end(), [&](const Spoke& s) { return s.angle != begin->angle; });
            if (!runs_up(begin->halfedge))
                std::reverse(begin, end);
            begin = end;
        }
        return spokes;
    }

    void link(const std::vector<Spoke>& spokes)
    {
        for (std::size_t i = 0; i < spokes.size(); ++i) {
            const Index one = spokes[i].halfedge;
            const Index next = spokes[(i + 1) % spokes.size()].halfedge;
            forwards_[place_of(one)] = next;
            backwards_[place_of(next)] = one;
        }
    }

    const PolygonMesh& mesh_;
    const Points& positions_;
    const Topology& topology_;
    /// For each half-edge of Topology::junctions, the next one counterclockwise and clockwise.
    std::vector<Index> forwards_;
    std::vector<Index> backwards_;
};

/// The volume on these sides of faces.
double volume_of(std::span<const Index> sides, const PolygonMesh& mesh, const Points& positions)
{
    double volume = 0.0;
    for (const Index side : sides) {
        const double cone = cone_volume(mesh.face(side / 2), positions, positions.row(mesh.face(sides[0] / 2).front()));
        volume += side % 2 == 0 ? -cone : cone;
    }
    return volume;
}

/// The volume, or 0 if it may be merely rounding of positions in single precision, as between repeated faces.
double certain_volume_of(std::span<const Index> sides, const PolygonMesh& mesh, const Points& positions)
{
    double area = 0.0;
    for (const Index side : sides)
        area += vector_area(mesh.face(side / 2), positions).stableNorm();
    const double volume = volume_of(sides, mesh, positions);
    return std::abs(volume) > 1e-7 * area * std::sqrt(area) ? volume : 0.0;
}

/// The sides of each region, without faces that have it on both sides.
IndexLists sides_of(const Components& regions)
{
    IndexLists sides;
    for (Index r = 0; r < regions.count(); ++r) {
        for (const Index side : regions.nodes[r])
            if (regions.component_of[side ^ 1] != r)
                sides.values.push_back(side);
        sides.close();
    }
    return sides;
}

}  // namespace

EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    Topology topology = make_topology(mesh, exec);
    free_junctions(mesh, topology, exec);
    const SheetOrder order(mesh, positions, topology, exec);
    const IndexLists sides = sides_of(connected_components(
        2 * mesh.n_faces(), [&](Index side, auto&& visit) { order.for_each_neighbour_of(side, visit); }));
    std::vector<double> volumes(at(sides.size()));
    for_each(exec, sides.size(), [&](Index r) { volumes[r] = certain_volume_of(sides[r], mesh, positions); });
    // Around all faces, outside, it is negative.
    std::vector<Index> largest_first = select(exec, sides.size(), [&](Index r) { return volumes[r] > 0.0; });
    std::ranges::stable_sort(largest_first, std::greater<>(), [&](Index r) { return volumes[r]; });
    EnclosedCells cells;
    for (const Index r : largest_first) {
        cells.sides.values.insert(cells.sides.values.end(), sides[r].begin(), sides[r].end());
        cells.sides.close();
    }
    return cells;
}

std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec)
{
    std::vector<double> volumes(at(cells.count()));
    for_each(exec, cells.count(), [&](Index c) { volumes[c] = volume_of(cells.sides[c], mesh, positions); });
    return volumes;
}

}  // namespace seamflow
