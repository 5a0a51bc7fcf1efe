#include "tests/support/reliefs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow::test {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// A body without relief. Coordinates u around it and v along it, in mean edges.
struct Base {
    Body body = Body::Plate;
    PolygonMesh mesh;
    /// #V by 3.
    Points normals;
    /// #V by 2.
    std::vector<std::array<double, 2>> coordinates;
    double around = 0.0;
    double along = 0.0;

    [[nodiscard]] bool closes_around() const { return body == Body::Tube || body == Body::Torus; }
    [[nodiscard]] bool closes_along() const { return body == Body::Torus; }

    /// Where coordinates of a plate, a tube or a torus are, and the normal there.
    [[nodiscard]] std::pair<Point, Point> at(double u, double v) const
    {
        if (body == Body::Plate)
            return {{u, v, 0.0}, {0.0, 0.0, 1.0}};
        const double radius = around / full_turn;
        const Point outwards(std::cos(u / radius), std::sin(u / radius), 0.0);
        const Point up(0.0, 0.0, 1.0);
        if (body == Body::Tube)
            return {radius * outwards + v * up, outwards};
        const double small = along / full_turn;
        const Point normal = std::cos(v / small) * outwards + std::sin(v / small) * up;
        return {radius * outwards + small * normal, normal};
    }
};

/// Faces of a lattice of m by n vertices, each cell cut into two triangles.
/// @param falls whether cell (i, j) is cut from the right to the left.
template <class Falls>
void add_cells(Base& base, Index m, Index n, Falls&& falls)
{
    const auto vertex = [m, n](Index i, Index j) { return (i % m) * n + j % n; };
    for (Index i = 0; i < (base.closes_around() ? m : m - 1); ++i)
        for (Index j = 0; j < (base.closes_along() ? n : n - 1); ++j) {
            const std::array corners{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
            const std::size_t first = falls(i, j) ? 1 : 0;
            for (const std::size_t k : {first, first + 2})
                base.mesh.add_face(std::array{corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]});
        }
}

/// The lattice in units of its cells: coordinates and faces.
void add_lattice(Base& base, Lattice lattice, Index m, Index n, RandomNumbers& random)
{
    const bool is_hexagonal = lattice == Lattice::Hexagonal;
    const double row = is_hexagonal ? std::sqrt(0.75) : 1.0;
    const auto moved = [&](bool moves) {
        return moves && lattice == Lattice::Jittered ? 0.22 * random.symmetric() : 0.0;
    };
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) {
            const double u = i + (is_hexagonal && j % 2 == 1 ? 0.5 : 0.0);
            base.coordinates.push_back({u + moved(base.closes_around() || (i > 0 && i < m - 1)),
                                        row * j + moved(base.closes_along() || (j > 0 && j < n - 1))});
        }
    add_cells(base, m, n, [&](Index, Index j) {
        return is_hexagonal ? j % 2 == 0 : lattice == Lattice::Jittered && random.below(2) == 0;
    });
    base.around = base.closes_around() ? m : m - 1;
    base.along = row * (base.closes_along() ? n : n - 1);
}

Base make_ball_base(Index vertices)
{
    Base base;
    base.body = Body::Ball;
    base.mesh = make_noisy_sphere(vertices, {.amplitude = 0.0, .noise = 0.0});
    base.normals = base.mesh.vertices;
    const double radius = 1.0 / mean_edge_length(base.mesh);
    base.mesh.vertices *= radius;
    base.around = full_turn * radius;
    base.along = std::numbers::pi * radius;
    for (const auto& normal : base.normals.rowwise())
        base.coordinates.push_back(
            {std::atan2(normal.y(), normal.x()) * radius, std::acos(std::clamp(normal.z(), -1.0, 1.0)) * radius});
    return base;
}

Base make_base(Body body, Lattice lattice, Index vertices)
{
    if (body == Body::Ball)
        return make_ball_base(vertices);
    Base base;
    base.body = body;
    RandomNumbers random(5);
    // A torus is four times as long around as along.
    const auto n = static_cast<Index>(std::lround(std::sqrt(vertices / (body == Body::Torus ? 4.0 : 1.0))));
    add_lattice(base, lattice, vertices / n, n, random);
    const auto set_positions = [&base] {
        base.mesh.vertices.resize(static_cast<Index>(base.coordinates.size()), 3);
        base.normals = base.mesh.vertices;
        for (Index v = 0; v < base.mesh.n_vertices(); ++v) {
            const auto [position, normal] = base.at(base.coordinates[usize(v)][0], base.coordinates[usize(v)][1]);
            base.mesh.vertices.row(v) = position;
            base.normals.row(v) = normal;
        }
    };
    set_positions();
    const double edge = mean_edge_length(base.mesh);
    for (auto& [u, v] : base.coordinates)
        u /= edge, v /= edge;
    base.around /= edge;
    base.along /= edge;
    set_positions();
    return base;
}

/// How often a wavelength goes into a length, at least once.
double times(double length, double wavelength)
{
    return std::max(1.0, std::round(length / wavelength));
}

/// Phases of a relief as functions of coordinates: (a, b) = matrix · (u, v).
Eigen::Matrix2d phases(const Base& base, const ReliefKind& kind)
{
    const double angle = kind.angle * std::numbers::pi / 180.0;
    if (base.body == Body::Plate)
        return Eigen::Rotation2Dd(-angle).toRotationMatrix() / kind.wavelength;
    Eigen::Matrix2d matrix;
    matrix(0, 0) = times(base.around, kind.wavelength) / base.around;
    matrix(0, 1) = 0.0;
    matrix(1, 0) = std::round(std::tan(angle) * base.around / kind.wavelength) / base.around;
    matrix(1, 1) = base.closes_along() ? times(base.along, kind.wavelength) / base.along : 1.0 / kind.wavelength;
    return matrix;
}

/// Centres of reliefs on a ball: on a spiral, as even as can be.
std::vector<Point> centres_on_ball(const Base& base, const ReliefKind& kind, RandomNumbers& random)
{
    const double radius = base.along / std::numbers::pi;
    const double per_wavelength = radius / kind.wavelength;
    const int n = static_cast<int>(2.0 / std::sqrt(3.0) * 2.0 * full_turn * per_wavelength * per_wavelength);
    std::vector<Point> centres;
    for (int i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n;
        const double angle = std::numbers::pi * (1.0 + std::sqrt(5.0)) * i;
        Point centre(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z);
        if (kind.relief.centres == Centres::Irregular)
            centre += 0.3 / per_wavelength * Point(random.symmetric(), random.symmetric(), random.symmetric());
        centres.emplace_back(radius * centre.normalized());
    }
    return centres;
}

/// Calls add(a, b) for the phases of the centres in one cell of a lattice.
template <class Add>
void add_centres(Centres centres, const Eigen::Vector2d& middle, RandomNumbers& random, Add&& add)
{
    const auto near_middle = [&](double reach) -> Eigen::Vector2d {
        return middle + reach * Eigen::Vector2d(random.symmetric(), random.symmetric());
    };
    if (centres != Centres::Strokes)
        return add(near_middle(centres == Centres::Irregular ? 0.35 : 0.0));
    constexpr int n_points = 12;
    for (int n_strokes = 2 + random.below(2); n_strokes > 0; --n_strokes) {
        const Eigen::Vector2d first = near_middle(0.35);
        const Eigen::Vector2d last = near_middle(0.35);
        for (int k = 0; k <= n_points; ++k)
            add(first + (last - first) * k / n_points);
    }
}

std::vector<Point> make_centres(const Base& base, const ReliefKind& kind, const Eigen::Matrix2d& to_phases)
{
    RandomNumbers random(7);
    if (kind.relief.centres == Centres::None)
        return {};
    if (base.body == Body::Ball)
        return centres_on_ball(base, kind, random);
    // Rows of a hexagonal lattice are closer to each other, and every second one is moved by half a wavelength.
    const bool is_hexagonal = kind.relief.centres == Centres::Hexagonal;
    const double n_along = base.closes_along() ? to_phases(1, 1) * base.along : 0.0;
    const double n_rows = 2.0 * times(n_along, std::sqrt(3.0));
    const double row = !is_hexagonal ? 1.0 : base.closes_along() ? n_along / n_rows : std::sqrt(0.75);
    const Eigen::Matrix2d to_coordinates = to_phases.inverse();
    // Those that go round once; on a plate turned in any way, all those that may lie on it.
    const int reach = static_cast<int>(2.0 * std::max(base.around, base.along) / kind.wavelength) + 2;
    const int n_around = static_cast<int>(std::lround(to_phases(0, 0) * base.around));
    std::vector<Point> centres;
    for (int i = base.closes_around() ? 0 : -reach; i < (base.closes_around() ? n_around : reach); ++i)
        for (int j = base.closes_along() ? 0 : -reach;
             j < (base.closes_along() ? static_cast<int>(std::lround(n_along / row)) : reach); ++j) {
            const Eigen::Vector2d middle(i + (is_hexagonal && j % 2 != 0 ? 1.0 : 0.5), row * (j + 0.5));
            add_centres(kind.relief.centres, middle, random, [&](const Eigen::Vector2d& phases) {
                const Eigen::Vector2d at = to_coordinates * phases;
                centres.push_back(base.at(at.x(), at.y()).first);
            });
        }
    return centres;
}

/// Sets the distances of a place from the centres.
void find_nearest(const std::vector<Point>& centres, const Point& position, Place& place)
{
    std::array least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (const Point& centre : centres) {
        const double distance = (position - centre).squaredNorm();
        if (distance < least[0])
            least = {distance, least[0]};
        else
            least[1] = std::min(least[1], distance);
    }
    place.nearest = std::sqrt(least[0]) / place.wavelength;
    place.next = std::sqrt(least[1]) / place.wavelength;
}

}  // namespace

ReliefSurface make_relief(const ReliefKind& kind, Index vertices)
{
    Base base = make_base(kind.body, kind.lattice, vertices);
    const Eigen::Matrix2d to_phases = phases(base, kind);
    const std::vector<Point> centres = make_centres(base, kind, to_phases);
    ReliefSurface surface{.mesh = base.mesh, .normals = base.normals, .heights = {}};
    for (Index v = 0; v < base.mesh.n_vertices(); ++v) {
        const auto& [around, along] = base.coordinates[usize(v)];
        const Eigen::Vector2d phase = to_phases * Eigen::Vector2d(around, along);
        const Point position = base.mesh.vertices.row(v);
        Place place{
            .a = phase.x(), .b = phase.y(), .position = position / kind.wavelength, .wavelength = kind.wavelength};
        find_nearest(centres, position, place);
        const double from_end = (kind.share * base.along - along) / (0.5 * kind.wavelength);
        const double fading = kind.share < 1.0 ? std::clamp(from_end, 0.0, 1.0) : 1.0;
        surface.heights.push_back(kind.height * fading * kind.relief.height(place));
        surface.mesh.vertices.row(v) += surface.heights.back() * surface.normals.row(v);
    }
    return surface;
}

}  // namespace seamflow::test
