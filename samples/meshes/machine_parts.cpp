#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "samples/meshes/building.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

using Point2 = Eigen::RowVector2d;
using Point3 = Eigen::RowVector3d;

/// A closed curve; all curves that a surface is swept along have equally many points.
using Curve = std::vector<Point3>;

void require_valid(Index vertices, const MachinePartShape& shape)
{
    require_between("the number of vertices", vertices, fewest_vertices_of_parts, 100'000'000);
    require_between("noise", shape.noise, 0.0, 1e6);
}

void add_quad(PolygonMesh& mesh, const std::array<Index, 4>& q, PartFaces faces)
{
    if (faces == PartFaces::Quads)
        return add_face(mesh, {q[0], q[1], q[2], q[3]});
    add_face(mesh, {q[0], q[1], q[2]});
    add_face(mesh, {q[0], q[2], q[3]});
}

PolygonMesh room_for(Index vertices, Index quads, PartFaces faces)
{
    const auto n = static_cast<std::size_t>(quads);
    return faces == PartFaces::Quads ? mesh_with_room(vertices, 4 * n, n) : mesh_with_room(vertices, 6 * n, 2 * n);
}

/// Displaces every vertex.
void add_noise(PolygonMesh& mesh, double area, const MachinePartShape& shape)
{
    RandomNumbers random(shape.seed);
    const double displacement = shape.noise * std::sqrt(area / mesh.n_vertices());
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            mesh.vertices(v, axis) += displacement * random.symmetric();
}

Index pieces(double length, double spacing)
{
    return std::max(Index{1}, static_cast<Index>(std::lround(length / spacing)));
}

/// The vertex spacing, among those near that for the area, that gives most nearly the number of vertices wanted.
double choose_spacing(Index wanted, double area, const std::function<double(double)>& vertices_with)
{
    constexpr int trials = 400;
    const double first = std::sqrt(area / wanted);
    double best = first;
    for (int i = 0; i < trials; ++i) {
        const double spacing = first * (0.6 + 0.8 * i / trials);
        if (std::abs(vertices_with(spacing) - wanted) < std::abs(vertices_with(best) - wanted))
            best = spacing;
    }
    return best;
}

/// A polygon as a curve, its sides divided.
Curve along(const std::vector<Point2>& polygon, const std::vector<Index>& divisions, double z)
{
    Curve curve;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (Index k = 0; k < divisions[i]; ++k) {
            const double t = static_cast<double>(k) / divisions[i];
            const Point2 p = (1.0 - t) * polygon[i] + t * polygon[(i + 1) % polygon.size()];
            curve.emplace_back(p.x(), p.y(), z);
        }
    return curve;
}

Curve circle(std::size_t n, double radius, double z, double first_angle = 0.0)
{
    Curve curve;
    for (std::size_t k = 0; k < n; ++k) {
        const double angle = first_angle + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
        curve.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return curve;
}

std::vector<Index> divide(const std::vector<Point2>& polygon, double spacing)
{
    std::vector<Index> divisions;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        divisions.push_back(pieces((polygon[(i + 1) % polygon.size()] - polygon[i]).norm(), spacing));
    return divisions;
}

/// The curves of a part for a spacing of vertices: each is joined to the next, and the last to the first.
using Outline = std::function<std::vector<Curve>(double spacing)>;

double distance_of(const Curve& a, const Curve& b)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += (a[k] - b[k]).norm();
    return sum / static_cast<double>(a.size());
}

/// The number of rings of vertices from each curve to the next.
std::vector<Index> rings_between(const std::vector<Curve>& curves, double spacing)
{
    std::vector<Index> rings;
    for (std::size_t j = 0; j < curves.size(); ++j)
        rings.push_back(pieces(distance_of(curves[j], curves[(j + 1) % curves.size()]), spacing));
    return rings;
}

/// The closed surface, with one hole, that curves sweep.
PolygonMesh sweep(Index vertices, double area, const Outline& outline, const MachinePartShape& shape)
{
    require_valid(vertices, shape);
    const double spacing = choose_spacing(vertices, area, [&](double trial) {
        const std::vector<Curve> curves = outline(trial);
        double rings = 0.0;
        for (const Index n : rings_between(curves, trial))
            rings += n;
        return rings * static_cast<double>(curves.front().size());
    });
    const std::vector<Curve> curves = outline(spacing);
    const std::vector<Index> rings = rings_between(curves, spacing);
    const auto around = static_cast<Index>(curves.front().size());
    Index n_rings = 0;
    for (const Index n : rings)
        n_rings += n;
    PolygonMesh mesh = room_for(n_rings * around, n_rings * around, shape.faces);
    Index v = 0;
    for (std::size_t j = 0; j < curves.size(); ++j)
        for (Index i = 0; i < rings[j]; ++i)
            for (std::size_t k = 0; k < curves[j].size(); ++k) {
                const double t = static_cast<double>(i) / rings[j];
                mesh.vertices.row(v++) = (1.0 - t) * curves[j][k] + t * curves[(j + 1) % curves.size()][k];
            }
    for (Index ring = 0; ring < n_rings; ++ring)
        for (Index k = 0; k < around; ++k) {
            const Index here = ring * around;
            const Index there = (ring + 1) % n_rings * around;
            const Index next = (k + 1) % around;
            add_quad(mesh, {here + k, here + next, there + next, there + k}, shape.faces);
        }
    add_noise(mesh, area, shape);
    return mesh;
}

/// The vertices of a box: rings around the z axis, followed by those inside the bottom and the top.
struct BoxGrid {
    Index x = 0;
    Index y = 0;
    Index z = 0;

    [[nodiscard]] Index around() const { return 2 * (x + y); }
    [[nodiscard]] Index inside() const { return (x - 1) * (y - 1); }
    [[nodiscard]] Index size() const { return around() * (z + 1) + 2 * inside(); }

    /// On the bottom (level 0) or the top (level z).
    [[nodiscard]] Index vertex(Index i, Index j, Index level) const
    {
        if (j == 0)
            return level * around() + i;
        if (i == x)
            return level * around() + x + j;
        if (j == y)
            return level * around() + 2 * x + y - i;
        if (i == 0)
            return level * around() + 2 * x + 2 * y - j;
        return around() * (z + 1) + (level == 0 ? 0 : inside()) + (j - 1) * (x - 1) + i - 1;
    }
};

}  // namespace

PolygonMesh make_box(Index vertices, const MachinePartShape& shape)
{
    require_valid(vertices, shape);
    const Point3 sides(1.6, 1.2, 1.0);
    const double area = 2.0 * (sides.x() * sides.y() + sides.y() * sides.z() + sides.z() * sides.x());
    const auto grid_with = [&](double spacing) {
        return BoxGrid{pieces(sides.x(), spacing), pieces(sides.y(), spacing), pieces(sides.z(), spacing)};
    };
    const BoxGrid grid =
        grid_with(choose_spacing(vertices, area, [&](double spacing) { return double(grid_with(spacing).size()); }));
    PolygonMesh mesh = room_for(grid.size(), grid.size() - 2, shape.faces);
    const auto place = [&](Index v, double i, double j, double k) {
        mesh.vertices.row(v) << sides.x() * i / grid.x, sides.y() * j / grid.y, sides.z() * k / grid.z;
    };
    for (const Index level : {Index{0}, grid.z})
        for (Index j = 0; j <= grid.y; ++j)
            for (Index i = 0; i <= grid.x; ++i)
                place(grid.vertex(i, j, level), i, j, level);
    for (Index k = 0; k < grid.around(); ++k)
        for (Index level = 1; level < grid.z; ++level) {
            mesh.vertices.row(level * grid.around() + k) = mesh.vertices.row(k);
            mesh.vertices(level * grid.around() + k, 2) = sides.z() * level / grid.z;
        }
    for (Index level = 0; level < grid.z; ++level)
        for (Index k = 0; k < grid.around(); ++k) {
            const Index here = level * grid.around();
            const Index next = (k + 1) % grid.around();
            add_quad(mesh, {here + k, here + next, here + grid.around() + next, here + grid.around() + k}, shape.faces);
        }
    for (Index j = 0; j < grid.y; ++j)
        for (Index i = 0; i < grid.x; ++i) {
            const auto corner = [&](Index di, Index dj, Index level) { return grid.vertex(i + di, j + dj, level); };
            add_quad(mesh, {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}, shape.faces);
            add_quad(mesh, {corner(0, 0, grid.z), corner(1, 0, grid.z), corner(1, 1, grid.z), corner(0, 1, grid.z)},
                     shape.faces);
        }
    add_noise(mesh, area, shape);
    return mesh;
}

PolygonMesh make_gear(Index vertices, const MachinePartShape& shape)
{
    constexpr int teeth = 10;
    constexpr double pitch = 2.0 * std::numbers::pi / teeth;
    constexpr double half_tip = 0.09;
    constexpr double half_base = 0.224;
    std::vector<Point2> polygon;
    const auto corner = [&](double radius, double angle) {
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    };
    for (int tooth = 0; tooth < teeth; ++tooth) {
        corner(1.0, tooth * pitch - half_tip);
        corner(1.0, tooth * pitch + half_tip);
        corner(0.8, tooth * pitch + half_base);
        corner(0.8, (tooth + 1) * pitch - half_base);
    }
    return sweep(
        vertices, 8.5,
        [&](double spacing) {
            const std::vector<Index> divisions = divide(polygon, 1.3 * spacing);
            const Curve top = along(polygon, divisions, 0.25);
            return std::vector<Curve>{circle(top.size(), 0.6, 0.25, -half_tip),
                                      circle(top.size(), 0.6, -0.25, -half_tip), along(polygon, divisions, -0.25), top};
        },
        shape);
}

PolygonMesh make_stepped_cylinder(Index vertices, const MachinePartShape& shape)
{
    return sweep(
        vertices, 15.5,
        [](double spacing) {
            const auto n = static_cast<std::size_t>(std::max(8.0, std::round(5.0 / spacing)));
            return std::vector<Curve>{circle(n, 0.5, 1.2), circle(n, 0.5, 0.0),  circle(n, 1.0, 0.0),
                                      circle(n, 1.0, 0.6), circle(n, 0.75, 0.6), circle(n, 0.75, 1.2)};
        },
        shape);
}

PolygonMesh make_chamfered_plate(Index vertices, const MachinePartShape& shape)
{
    constexpr double half_x = 1.1;
    constexpr double half_y = 0.9;
    constexpr double chamfer = 0.15;
    const auto rectangle = [](double inset) {
        const double x = half_x - inset;
        const double y = half_y - inset;
        return std::vector<Point2>{{x, -y}, {x, y}, {-x, y}, {-x, -y}};
    };
    return sweep(
        vertices, 11.5,
        [&](double spacing) {
            const std::vector<Index> divisions = divide(rectangle(0.0), 1.3 * spacing);
            const Curve rim = along(rectangle(0.0), divisions, 0.0);
            const double first_angle = -std::atan2(half_y, half_x);
            return std::vector<Curve>{circle(rim.size(), 0.5 + chamfer, 0.5, first_angle),
                                      circle(rim.size(), 0.5, 0.5 - chamfer, first_angle),
                                      circle(rim.size(), 0.5, 0.0, first_angle),
                                      rim,
                                      along(rectangle(0.0), divisions, 0.5 - chamfer),
                                      along(rectangle(chamfer), divisions, 0.5)};
        },
        shape);
}

}  // namespace seamflow
