#include "partition/metrics/nested_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "partition/disjoint_sets.h"
#include "partition/metrics/box_tree.h"
#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// Coordinates in which all lines run along the third axis. Their direction is that of hardly any edge or face.
class LineFrame {
  public:
    explicit LineFrame(const Point& origin)
        : origin_(origin)
        , rotation_(Eigen::Quaterniond(0.81, 0.29, -0.37, 0.345).normalized().toRotationMatrix())
    {
    }

    [[nodiscard]] Point operator()(const Point& p) const { return (p - origin_) * rotation_; }

  private:
    Point origin_;
    Eigen::Matrix3d rotation_;
};

/// Where a line crosses a face.
struct Crossing {
    Index line;
    /// The component that the face belongs to.
    Index component;
    double height;
    Index region_below;
    Index region_above;
};

/// Those of sorted crossings whose member has a value.
std::span<const Crossing> those_with(std::span<const Crossing> sorted, Index Crossing::*member, Index value)
{
    const auto begin = std::ranges::lower_bound(sorted, value, {}, member);
    const auto end = std::ranges::upper_bound(sorted, value, {}, member);
    return sorted.subspan(static_cast<std::size_t>(begin - sorted.begin()), static_cast<std::size_t>(end - begin));
}

/// A triangle in the frame of the lines.
struct SeenTriangle {
    Triangle vertices;
    TriangleCorners corners;
};

/// Twice the area of the triangle of a foot and an edge, counterclockwise. It is computed from the lower vertex to the
/// higher, so that the two triangles at an edge agree on which side of it the line is, and no line slips between them.
double area_beside(const Point& foot, const SeenTriangle& t, std::size_t k)
{
    const std::size_t next = (k + 1) % 3;
    const bool is_upwards = t.vertices[k] < t.vertices[next];
    const Point a = t.corners[is_upwards ? k : next] - foot;
    const Point b = t.corners[is_upwards ? next : k] - foot;
    const double area = a[0] * b[1] - a[1] * b[0];
    return is_upwards ? area : -area;
}

/// Where a line passes through a triangle.
struct Passage {
    double height;
    /// Whether the line, upwards, comes from the triangle's back.
    bool is_from_back;
};

/// Nothing if the line is beside the triangle.
std::optional<Passage> passage_of(const Point& foot, const SeenTriangle& t)
{
    // Each area is beside the edge opposite to the corner that it weights.
    const std::array weights{area_beside(foot, t, 1), area_beside(foot, t, 2), area_beside(foot, t, 0)};
    const double total = weights[0] + weights[1] + weights[2];
    if (std::ranges::any_of(weights, [&](double w) { return total > 0.0 ? w < 0.0 : w > 0.0; }) || !(total != 0.0))
        return std::nullopt;
    double height = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        height += weights[k] / total * t.corners[k][2];
    return Passage{height, total > 0.0};
}

/// Lines through surfaces, each around which a region lies.
struct Lines {
    /// The region around the surface.
    std::vector<Index> outer;
    /// Where the line meets the plane through the origin of the frame.
    std::vector<Point> feet;
};

class NestSearch {
  public:
    NestSearch(const PolygonMesh& mesh, const Points& positions, const Regions& regions, const Executor& exec)
        : mesh_(mesh)
        , positions_(positions)
        , regions_(regions)
        , frame_(positions.row(mesh.face_vertices.front()))
        , component_of_(components(exec))
    {
    }

    /// @param outer the regions around surfaces.
    /// @returns for each region the cell that its surface is a hole of, or -1.
    [[nodiscard]] std::vector<Index> run(const std::vector<Index>& outer, const Executor& exec) const
    {
        const Lines lines = lines_through(outer, exec);
        const std::vector<Crossing> crossings = crossings_of(lines, exec);
        std::vector<Index> cell_around(at(regions_.count()), -1);
        for_each(exec, static_cast<Index>(outer.size()), [&](Index line) {
            const Index region = lines.outer[line];
            cell_around[region] = innermost_around(region, those_with(crossings, &Crossing::line, line));
        });
        return cell_around;
    }

  private:
    [[nodiscard]] std::vector<Index> components(const Executor& exec) const;
    [[nodiscard]] std::vector<SeenTriangle> seen(Index f) const;
    [[nodiscard]] Point foot_within(Index outer) const;
    [[nodiscard]] Lines lines_through(const std::vector<Index>& outer, const Executor& exec) const;
    [[nodiscard]] std::vector<Crossing> crossings_of(const Lines& lines, const Executor& exec) const;
    [[nodiscard]] std::optional<double> height_within(std::span<const Crossing> own) const;
    [[nodiscard]] Index innermost_around(Index outer, std::span<const Crossing> crossings) const;

    const PolygonMesh& mesh_;
    const Points& positions_;
    const Regions& regions_;
    LineFrame frame_;
    /// For each region, the connected component of the faces at it.
    std::vector<Index> component_of_;
};

std::vector<Index> NestSearch::components(const Executor& exec) const
{
    DisjointSets sets(regions_.count(), exec);
    for_each(exec, mesh_.n_faces(), [&](Index f) { sets.join(regions_.of_side[2 * f], regions_.of_side[2 * f + 1]); });
    return sets.numbered(exec).first;
}

std::vector<SeenTriangle> NestSearch::seen(Index f) const
{
    std::vector<Triangle> triangles;
    triangulate(mesh_.face(f), positions_, triangles);
    std::vector<SeenTriangle> all;
    for (const Triangle& t : triangles)
        all.push_back({t, {frame_(positions_.row(t[0])), frame_(positions_.row(t[1])), frame_(positions_.row(t[2]))}});
    return all;
}

/// In the middle of the triangle that is largest in the plane, of some faces of the surface.
Point NestSearch::foot_within(Index outer) const
{
    constexpr std::size_t most_tried = 1000;
    const std::span<const Index> sides = regions_.sides[outer];
    Point foot = Point::Zero();
    double largest = -1.0;
    for (const Index side : sides.first(std::min(sides.size(), most_tried)))
        for (const SeenTriangle& t : seen(side / 2)) {
            const auto& [a, b, c] = t.corners;
            if (const double area = std::abs((b - a).cross(c - a)[2]); area > largest) {
                largest = area;
                foot = (a + b + c) / 3.0;
            }
        }
    foot[2] = 0.0;
    return foot;
}

/// In an order in which neighbours are near each other.
Lines NestSearch::lines_through(const std::vector<Index>& outer, const Executor& exec) const
{
    const auto n = static_cast<Index>(outer.size());
    std::vector<Point> feet(outer.size());
    for_each(exec, n, [&](Index i) { feet[i] = foot_within(outer[i]); });
    Box whole;
    for (const Point& foot : feet)
        whole.add(foot);
    std::vector<std::pair<std::uint64_t, Index>> order(outer.size());
    for_each(exec, n, [&](Index i) { order[i] = {place_on_curve({feet[i], feet[i]}, whole), i}; });
    std::ranges::sort(order);
    Lines lines;
    for (const auto& [place, i] : order) {
        lines.outer.push_back(outer[i]);
        lines.feet.push_back(feet[i]);
    }
    return lines;
}

/// Those of each line together, by component, upwards.
std::vector<Crossing> NestSearch::crossings_of(const Lines& lines, const Executor& exec) const
{
    std::vector<Box> leaves;
    for (const Point& foot : lines.feet)
        leaves.push_back({foot, foot});
    const BoxTree tree(std::move(leaves));
    const auto add_face = [&](std::vector<Crossing>& crossings, Index f) {
        Box box;
        for (const Index v : mesh_.face(f))
            box.add(frame_(positions_.row(v)));
        box.low[2] = box.high[2] = 0.0;
        std::vector<SeenTriangle> triangles;
        tree.for_each_meeting(box, 0, [&](Index line) {
            if (triangles.empty())
                triangles = seen(f);
            for (const SeenTriangle& t : triangles)
                if (const auto passage = passage_of(lines.feet[line], t)) {
                    const Index side_below = 2 * f + (passage->is_from_back ? 1 : 0);
                    const Index region = regions_.of_side[side_below];
                    crossings.push_back({.line = line,
                                         .component = component_of_[region],
                                         .height = passage->height,
                                         .region_below = region,
                                         .region_above = regions_.of_side[side_below ^ 1]});
                }
        });
    };
    auto crossings = reduce(exec, mesh_.n_faces(), std::vector<Crossing>{}, add_face,
                            [](auto& all, const auto& part) { all.insert(all.end(), part.begin(), part.end()); });
    std::ranges::stable_sort(crossings, {},
                             [](const Crossing& c) { return std::tuple(c.line, c.component, c.height); });
    return crossings;
}

/// In the middle of the longest part of the line that is within the surface.
std::optional<double> NestSearch::height_within(std::span<const Crossing> own) const
{
    std::optional<double> height;
    double longest = 0.0;
    for (std::size_t i = 1; i < own.size(); ++i)
        if (const double length = own[i].height - own[i - 1].height;
            length > longest && regions_.volumes[own[i - 1].region_above] > 0.0) {
            longest = length;
            height = own[i - 1].height + 0.5 * length;
        }
    return height;
}

/// Of all cells around a point within the surface, the smallest. Copies of the surface do not contain each other.
Index NestSearch::innermost_around(Index outer, std::span<const Crossing> crossings) const
{
    const std::optional<double> height =
        height_within(those_with(crossings, &Crossing::component, component_of_[outer]));
    if (!height)
        return -1;
    const double smallest = -(1.0 + 1e-7) * regions_.volumes[outer];
    Index innermost = -1;
    Index decided = -1;
    for (const Crossing& c : crossings) {
        // Regions without volume are between sheets that lie on each other, or at open ones.
        if (c.component == component_of_[outer] || c.component == decided || c.height < *height ||
            regions_.volumes[c.region_below] == 0.0)
            continue;
        decided = c.component;
        const double volume = regions_.volumes[c.region_below];
        if (volume > smallest && (innermost < 0 || volume < regions_.volumes[innermost]))
            innermost = c.region_below;
    }
    return innermost;
}

}  // namespace

std::vector<Index> containing_cells(const PolygonMesh& mesh, const Points& positions, const Regions& regions,
                                    const Executor& exec)
{
    const std::vector<Index> outer = select(exec, regions.count(), [&](Index r) { return regions.volumes[r] < 0.0; });
    if (outer.size() < 2)
        return std::vector<Index>(at(regions.count()), -1);
    return NestSearch(mesh, positions, regions, exec).run(outer, exec);
}

}  // namespace seamflow
