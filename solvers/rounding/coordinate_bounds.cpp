#include "solvers/rounding/coordinate_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "solvers/rounding/flat_facets.h"

namespace seamflow {

namespace {

/// In lengths of edges: smaller steps are not seen. Of heights they are, as terraces, where the ground is nearly level.
constexpr double least_visible_step = 0.1;
constexpr double least_visible_height = 0.01;
/// The fraction of the vertices, of those on planes of all three coordinates, that lie in the middle of an edge of the
/// lattice, for a surface of marching cubes.
constexpr double most_in_middles = 0.95;
/// Steps are equal if the largest is at most this many times the smallest.
constexpr double equal_steps = 1.5;
/// In smallest steps: how far a vertex of marching cubes may move across the edge of the lattice on which it is. The
/// true surface crosses this edge, but where it has an edge itself, vertices on the lattice would bevel it. Between
/// slices, with unequal steps, it would drift (ball 2.1 and 2.8°, tube .22 and .29 steps off with .2 and .35).
constexpr double across_edge = 0.35;
constexpr double across_edge_of_slices = 0.2;
/// The fraction of the vertices with places of their own in the plane of two coordinates, for heights over this plane.
constexpr double most_with_own_place = 0.99;
/// Heights have at least this many planes with at least this fraction of the vertices.
constexpr std::ptrdiff_t least_planes = 4;
constexpr double part_of_plane = 0.005;
/// The number of parts whose own steps are tried, the largest first, if not all parts have the same.
constexpr std::size_t most_parts = 8;
/// The fraction of the vertices on planes, for a part that has steps. Few of a part that has none are there by chance;
/// many of a part that has been cut are not.
constexpr double least_on_planes = 0.5;
/// Faces over a plane cover at most this many times the rectangle around them: more if some overlap, as tiles may;
/// those of closed surfaces lie above each other.
constexpr double most_covered = 1.2;
/// Steps that are given and found are the same if they differ by at most this fraction.
constexpr double same_step = 0.01;

/// The bounds of half a step around each vertex.
Points half_steps(const Points& points, const Point& steps)
{
    return 0.5 * steps.replicate(points.rows(), 1);
}

/// Per vertex, one bit per coordinate: whether the number of its plane is odd; nothing for a vertex that is not on
/// planes of all three.
std::vector<std::optional<std::uint8_t>> odd_planes(const Points& points, const std::array<CoordinateSteps, 3>& steps,
                                                    const Executor& exec)
{
    std::vector<std::optional<std::uint8_t>> odd(static_cast<std::size_t>(points.rows()));
    for_each(exec, static_cast<Index>(points.rows()), [&](Index v) {
        unsigned bits = 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const double value = points(v, axis);
            if (!steps[axis].has(value))
                return;
            bits |= (std::fmod(steps[axis].plane_of(value), 2.0) != 0.0 ? 1U : 0U) << axis;
        }
        odd[usize(v)] = static_cast<std::uint8_t>(bits);
    });
    return odd;
}

/// The bounds of a surface of marching cubes; nothing if it is none. There all coordinates of a vertex lie on planes
/// through centres of voxels, but for one, which is in the middle between two. The steps that are found are half of
/// those of the voxels.
std::optional<CoordinateBounds>
bounds_of_marching_cubes(const Points& points, const std::array<CoordinateSteps, 3>& steps, const Executor& exec)
{
    const std::vector<std::optional<std::uint8_t>> odd = odd_planes(points, steps, exec);
    std::array<double, 8> counts{};
    for (const auto& bits : odd)
        if (bits)
            counts[*bits] += 1.0;
    const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
    // Bits of the planes on which the points of the lattice lie, the centres of voxels. A vertex in the middle of an
    // edge differs in one bit, that of the axis of the edge.
    for (unsigned of_lattice = 0; of_lattice < 8; ++of_lattice) {
        const double n_in_middles = counts[of_lattice ^ 1U] + counts[of_lattice ^ 2U] + counts[of_lattice ^ 4U];
        if (!(n_in_middles >= most_in_middles * total))
            continue;
        CoordinateBounds bounds{.kind = CoordinateBounds::Kind::MarchingCubes};
        for (unsigned axis = 0; axis < 3; ++axis)
            bounds.steps[axis] = 2.0 * steps[axis].step;
        bounds.half_widths = half_steps(points, bounds.steps);
        const double across =
            (has_equal_steps(bounds.steps) ? across_edge : across_edge_of_slices) * bounds.steps.minCoeff();
        for_each(exec, static_cast<Index>(points.rows()), [&](Index v) {
            if (const auto& bits = odd[usize(v)])
                for (unsigned axis = 0; axis < 3; ++axis)
                    if ((*bits ^ of_lattice) != 1U << axis)
                        bounds.half_widths(v, axis) = across;
        });
        return bounds;
    }
    return std::nullopt;
}

/// Whether nearly all vertices differ from all others in these two coordinates.
bool have_own_places(const Points& points, unsigned first, unsigned second)
{
    std::vector<std::pair<double, double>> places;
    places.reserve(static_cast<std::size_t>(points.rows()));
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        places.emplace_back(points(v, first), points(v, second));
    std::ranges::sort(places);
    const auto n_places = std::unique(places.begin(), places.end()) - places.begin();
    return static_cast<double>(n_places) >= most_with_own_place * static_cast<double>(points.rows());
}

/// The number of planes of a coordinate between its smallest and largest value.
double count_planes(const Points& points, const CoordinateSteps& steps, unsigned axis)
{
    return 1.0 + (points.col(axis).maxCoeff() - points.col(axis).minCoeff()) / steps.step;
}

/// The coordinate that is a height over the other two, in which nearly all vertices have places of their own: heights
/// on a grid, whether they are rounded or not, or rounded heights at any places; nothing for other surfaces.
/// @param seen see SurfaceSize.
std::optional<unsigned> axis_of_heights(const Points& points, const std::array<CoordinateSteps, 3>& steps,
                                        const Point& visible, const Point& seen)
{
    const Point extent = points.colwise().maxCoeff() - points.colwise().minCoeff();
    std::optional<unsigned> found;
    // Of several, such as on a steep slope, where height and one coordinate make a place, too, that above the grid
    // which the vertices fill best.
    double fullest = 0.0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned first = (axis + 1) % 3;
        const unsigned second = (axis + 2) % 3;
        const bool is_grid = steps[first].step > 0.0 && steps[second].step > 0.0;
        if (!(is_grid || visible[axis] > 0.0) || seen[axis] > most_covered * extent[first] * extent[second] ||
            !have_own_places(points, first, second))
            continue;
        const double filled =
            is_grid ? static_cast<double>(points.rows()) /
                          (count_planes(points, steps[first], first) * count_planes(points, steps[second], second))
                    : 0.0;
        if (!found || filled > fullest) {
            found = axis;
            fullest = filled;
        }
    }
    return found;
}

/// Whether several planes have many values: between two or three alone, a step is as likely the edge of a shape.
bool has_several_planes(const Points& points, const CoordinateSteps& steps, unsigned axis)
{
    std::map<double, Index> counts;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        ++counts[steps.plane_of(points(v, axis))];
    const double many = part_of_plane * static_cast<double>(points.rows());
    return std::ranges::count_if(counts, [many](const auto& plane) { return plane.second >= many; }) >= least_planes;
}

/// Vertices away from the lattice, with all their neighbours, have not been rounded: they get no half-width. Those
/// beside vertices on it are of a cut through faces that were.
void hold_exact_vertices(const Points& points, const std::array<CoordinateSteps, 3>& steps,
                         const IndexLists& neighbours, CoordinateBounds& bounds, const Executor& exec)
{
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (bounds.steps[axis] == 0.0)
            continue;
        const auto is_on_plane = [&](Index v) { return steps[axis].has(points(v, axis)); };
        for_each(exec, static_cast<Index>(points.rows()), [&](Index v) {
            if (!is_on_plane(v) && std::ranges::none_of(neighbours[v], is_on_plane))
                bounds.half_widths(v, axis) = 0.0;
        });
    }
}

/// The bounds by the kind of surface, without regard to single vertices.
CoordinateBounds bounds_by_kind(const Points& points, const std::array<CoordinateSteps, 3>& steps,
                                const SurfaceSize& size, const Executor& exec)
{
    const auto visible = [&](double least) {
        Point found = Point::Zero();
        for (unsigned axis = 0; axis < 3; ++axis)
            if (steps[axis].step >= least * size.edge)
                found[axis] = steps[axis].step;
        return found;
    };
    const Point of_heights = visible(least_visible_height);
    if (of_heights.isZero(0.0))
        return {};
    if (const std::optional<unsigned> axis = axis_of_heights(points, steps, of_heights, size.seen)) {
        Point heights = Point::Zero();
        heights[*axis] = of_heights[*axis];
        if (heights.isZero(0.0) || !has_several_planes(points, steps[*axis], *axis))
            return {};
        return {CoordinateBounds::Kind::Heights, heights, half_steps(points, heights)};
    }
    const Point of_all = visible(least_visible_step);
    if (of_all.isZero(0.0))
        return {};
    if (of_all.minCoeff() > 0.0)
        if (std::optional<CoordinateBounds> found = bounds_of_marching_cubes(points, steps, exec))
            return std::move(*found);
    return {CoordinateBounds::Kind::Any, of_all, half_steps(points, of_all)};
}

/// The vertices of parts that have steps.
struct RoundedParts {
    std::array<CoordinateSteps, 3> steps;
    /// Ascending.
    std::vector<Index> vertices;

    /// The number of their coordinates that have steps.
    [[nodiscard]] double n_coordinates() const
    {
        return static_cast<double>(vertices.size() * usize(static_cast<Index>(std::ranges::count_if(
                                                         steps, [](const auto& of) { return of.step > 0.0; }))));
    }
};

/// The parts that have given steps.
/// @param parts the vertices of each.
RoundedParts parts_with(const std::array<CoordinateSteps, 3>& steps, const Points& points, const IndexLists& parts)
{
    RoundedParts rounded{steps, {}};
    for (Index part = 0; part < parts.size(); ++part) {
        const std::span<const Index> vertices = parts[part];
        const auto is_on_planes = [&](unsigned axis) {
            const auto n = std::ranges::count_if(vertices, [&](Index v) { return steps[axis].has(points(v, axis)); });
            return static_cast<double>(n) >= least_on_planes * static_cast<double>(vertices.size());
        };
        bool has_steps = true;
        for (unsigned axis = 0; axis < 3; ++axis)
            has_steps = has_steps && (steps[axis].step == 0.0 || is_on_planes(axis));
        if (has_steps)
            rounded.vertices.insert(rounded.vertices.end(), vertices.begin(), vertices.end());
    }
    std::ranges::sort(rounded.vertices);
    return rounded;
}

/// The steps that most coordinates have, and the parts with them.
/// @param used the vertices with faces, ascending. @param part_of see bounds_of.
/// @param size of all parts; replaced by that of the parts with steps.
RoundedParts find_rounded_parts(const Points& points, const std::vector<Index>& used, std::span<const Index> part_of,
                                const SizeOfParts& size_of_parts, SurfaceSize& size, const Executor& exec)
{
    const auto steps_of = [&](std::span<const Index> vertices, double edge) {
        return find_coordinate_steps(points(vertices, Eigen::all), edge, exec);
    };
    if (part_of.empty())
        return {steps_of(used, size.edge), used};
    const Index n_parts = 1 + *std::ranges::max_element(part_of);
    const IndexLists parts = make_lists(n_parts, [&](auto&& add) {
        for (const Index v : used)
            add(part_of[v], v);
    });
    RoundedParts best = parts_with(steps_of(used, size.edge), points, parts);
    if (std::ranges::any_of(best.steps, [](const auto& of) { return of.step == 0.0; })) {
        std::vector<Index> largest(usize(n_parts));
        std::iota(largest.begin(), largest.end(), Index{0});
        std::ranges::stable_sort(largest, std::greater(), [&](Index part) { return parts[part].size(); });
        largest.resize(std::min(largest.size(), most_parts));
        for (const Index part : largest) {
            if (parts[part].size() == used.size())
                break;
            const SurfaceSize of_part = size_of_parts([&](Index v) { return part_of[v] == part; });
            RoundedParts own = parts_with(steps_of(parts[part], of_part.edge), points, parts);
            if (own.n_coordinates() > best.n_coordinates())
                best = std::move(own);
        }
    }
    if (best.vertices.size() < used.size()) {
        std::vector<std::uint8_t> has_steps(part_of.size(), 0);
        for (const Index v : best.vertices)
            has_steps[usize(v)] = 1;
        size = size_of_parts([&](Index v) { return has_steps[usize(v)] != 0; });
    }
    return best;
}

}  // namespace

bool has_equal_steps(const Point& steps)
{
    return steps.maxCoeff() <= equal_steps * steps.minCoeff();
}

SurfaceSize size_of(const PolygonMesh& mesh, const Points& points, const std::function<bool(Index)>& counts,
                    const Executor& exec)
{
    const auto is_counted = [&](Index f) { return !counts || std::ranges::all_of(mesh.face(f), counts); };
    SurfaceSize size;
    if (!counts) {
        size.edge = mean_edge_length(mesh, points, exec);
    } else {
        Eigen::RowVector2d sums = Eigen::RowVector2d::Zero();
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            if (!is_counted(f))
                continue;
            Index from = mesh.face(f).back();
            for (const Index to : mesh.face(f)) {
                sums += Eigen::RowVector2d((points.row(to) - points.row(from)).norm(), 1.0);
                from = to;
            }
        }
        size.edge = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point lowest = Point::Constant(infinity);
    Point highest = Point::Constant(-infinity);
    for (const Index v : mesh.face_vertices)
        if (!counts || counts(v)) {
            lowest = lowest.cwiseMin(points.row(v));
            highest = highest.cwiseMax(points.row(v));
        }
    for (int axis = 0; axis < 3; ++axis)
        size.seen[axis] = sum(exec, mesh.n_faces(), [&](Index f) {
            const auto is_at = [&](double value) {
                return std::ranges::all_of(mesh.face(f), [&](Index v) { return points(v, axis) == value; });
            };
            return is_counted(f) && !is_at(lowest[axis]) && !is_at(highest[axis])
                       ? std::abs(vector_area(mesh.face(f), points)[axis])
                       : 0.0;
        });
    return size;
}

CoordinateBounds bounds_of(const Points& points, const IndexLists& neighbours, std::span<const Index> part_of,
                           const SizeOfParts& size_of_parts, const Executor& exec)
{
    // Vertices without faces may lie anywhere.
    const std::vector<Index> used =
        select(exec, static_cast<Index>(points.rows()), [&](Index v) { return !neighbours[v].empty(); });
    SurfaceSize size = size_of_parts({});
    const RoundedParts rounded = find_rounded_parts(points, used, part_of, size_of_parts, size, exec);
    if (rounded.vertices.empty())
        return {};
    CoordinateBounds bounds = bounds_by_kind(points(rounded.vertices, Eigen::all), rounded.steps, size, exec);
    if (bounds.kind == CoordinateBounds::Kind::None)
        return bounds;
    Points half_widths = Points::Zero(points.rows(), 3);
    half_widths(rounded.vertices, Eigen::all) = bounds.half_widths;
    bounds.half_widths = std::move(half_widths);
    hold_exact_vertices(points, rounded.steps, neighbours, bounds, exec);
    bounds.edge = size.edge;
    bounds.flat = flat_facets(points, neighbours, rounded.steps, bounds.steps, exec);
    return bounds;
}

CoordinateBounds bounds_of(const Points& points, const IndexLists& neighbours, const SizeOfParts& size_of_parts,
                           const Point& steps, const Executor& exec)
{
    CoordinateBounds found = bounds_of(points, neighbours, {}, size_of_parts, exec);
    const auto agrees = [&](int axis) {
        if (found.steps[axis] == 0.0)
            return steps[axis] == 0.0 || found.kind == CoordinateBounds::Kind::Heights;
        return std::abs(found.steps[axis] - steps[axis]) <= same_step * steps[axis];
    };
    if (found.kind != CoordinateBounds::Kind::None && agrees(0) && agrees(1) && agrees(2))
        return found;
    return {CoordinateBounds::Kind::Any, steps, half_steps(points, steps)};
}

}  // namespace seamflow
