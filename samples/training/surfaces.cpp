#include "samples/training/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/topology.h"
#include "samples/training/draws.h"
#include "samples/training/gradient_noise.h"
#include "samples/training/solids.h"

namespace seamflow {

namespace {

constexpr Index fewest_faces = 1'000;
/// Of a surface whose angles between faces, in degrees, have a larger mean, little can be learned.
constexpr double roughest = 24.0;

/// How a smooth surface gets its shape. Angles are in degrees.
struct Relief {
    int least_rounds;
    int most_rounds;
    int most_octaves;
    int least_layers;
    int most_layers;
    /// How much rougher than the base.
    double least_angle;
    double most_angle;
};
constexpr Relief plain{0, 25, 4, 0, 3, 0.5, 8.0};
constexpr Relief rich{15, 90, 6, 1, 4, 1.5, 14.0};
constexpr Relief calm{20, 90, 4, 0, 1, 0.2, 2.0};
constexpr Relief of_height_field{0, 0, 6, 0, 3, 0.5, 10.0};

/// The mean angle between faces that share an edge, in degrees.
double mean_angle(const PolygonMesh& mesh, const Topology& topology, const Points& positions)
{
    double total = 0.0;
    Index n = 0;
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const Index twin = topology.twin[h];
        if (twin <= h)
            continue;
        const Point normal = vector_area(mesh.face(topology.face_of[h]), positions).normalized();
        const Point other = vector_area(mesh.face(topology.face_of[twin]), positions).normalized();
        total += std::acos(std::clamp(normal.dot(other), -1.0, 1.0));
        ++n;
    }
    return total / std::max(n, Index{1}) * 180.0 / std::numbers::pi;
}

/// Heights above a surface, which depend on the place in space.
class Pattern {
  public:
    Pattern(double edge, int n_octaves, RandomNumbers& random)
        : wave_(edge * scale_between(random, 5.0, 60.0))
        , finest_(3.3 * edge)
        , height_(0.25 * wave_ * scale_between(random, 0.1, 0.9))
        , profile_(random.below(8))
        , n_octaves_(n_octaves)
        , gain_(between(random, 0.35, 0.6))
        , warp_(chance(random, 0.4) ? between(random, 0.0, 1.5) : 0.0)
        , width_(between(random, 0.05, 0.2))
        , level_(between(random, -0.3, 0.3))
        , frequency_(std::min(between(random, 1.5, 4.0), 0.2 * wave_ / edge))
        , direction_(random_direction(random))
        , mask_wave_(chance(random, 0.5) ? edge * scale_between(random, 15.0, 80.0) : 0.0)
        , mask_level_(between(random, -0.2, 0.3))
        , noise_(random)
        , warping_(random)
        , mask_(random)
    {
    }

    double operator()(const Point& position) const
    {
        Point p = position / wave_;
        p += warp_ * warping_.vector(p);
        double total = 0.0;
        double amplitude = 1.0;
        double scale = 1.0;
        for (int octave = 0; octave < n_octaves_ && wave_ > finest_ * scale; ++octave) {
            total += amplitude * profile(noise_(scale * p + Point::Constant(10.7 * octave)), p);
            amplitude *= gain_;
            scale *= 2.0;
        }
        return height_ * mask(position) * (profile_ == 4 ? std::max(total, level_) : total);
    }

  private:
    /// Ridges, creases, terraces, lines, stripes or bumps from a smooth function.
    [[nodiscard]] double profile(double x, const Point& p) const
    {
        switch (profile_) {
        case 1:
            return 1.0 - 2.0 * std::abs(x);
        case 2:
            return std::abs(x);
        case 3:
            return 0.5 * std::tanh(5.0 * x);
        case 5:
            return 0.6 * std::exp(-x * x / (width_ * width_));
        case 6:
            return 0.4 * std::sin(2.0 * std::numbers::pi * (frequency_ * direction_.dot(p) + 2.5 * x));
        case 7:
            return 0.7 * std::sqrt(std::abs(x));
        default:
            return x;
        }
    }

    /// 0 where the pattern is not, up to 1.
    [[nodiscard]] double mask(const Point& position) const
    {
        if (mask_wave_ == 0.0)
            return 1.0;
        const double x = std::clamp(5.0 * (mask_(position / mask_wave_) - mask_level_), 0.0, 1.0);
        return x * x * (3.0 - 2.0 * x);
    }

    double wave_;
    double finest_;
    double height_;
    int profile_;
    int n_octaves_;
    double gain_;
    double warp_;
    double width_;
    double level_;
    double frequency_;
    Point direction_;
    double mask_wave_;
    double mask_level_;
    GradientNoise noise_;
    GradientNoise warping_;
    GradientNoise mask_;
};

/// Moves vertices along the surface, smooths it (Taubin, 1995) and adds patterns, whose height is lowered where the
/// result would be too rough.
void add_relief(PolygonMesh& mesh, const Relief& relief, RandomNumbers& random)
{
    constexpr int lowerings = 8;
    constexpr double lower = 0.65;
    const Topology topology = make_topology(mesh);
    const VertexNormals normals(mesh, topology);
    const double edge = mean_edge_length(mesh);
    Points& positions = mesh.vertices;
    const auto move_all = [&](auto&& motion) {
        const Points before = positions;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            positions.row(v) += motion(v, before);
    };
    const double shift = chance(random, 0.6) ? between(random, 0.0, 0.12 * edge) : 0.0;
    move_all([&](Index v, const Points& before) {
        const Point normal = normals(v, before);
        const Point motion = normal_vector(random);
        return Point(shift * (motion - motion.dot(normal) * normal));
    });
    std::vector<std::vector<Index>> neighbours;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        neighbours.push_back(neighbours_of(mesh, topology, v));
    const int rounds = whole_between(random, relief.least_rounds, relief.most_rounds);
    for (int round = 0; round < rounds; ++round)
        for (const double factor : {0.5, -0.51})
            move_all([&](Index v, const Points& before) {
                Point total = Point::Zero();
                for (const Index w : neighbours[v])
                    total += before.row(w);
                return Point(factor * (total / static_cast<double>(neighbours[v].size()) - before.row(v)));
            });
    const Points base = positions;
    const double most = mean_angle(mesh, topology, base) + between(random, relief.least_angle, relief.most_angle);
    for (int layers = whole_between(random, relief.least_layers, relief.most_layers); layers > 0; --layers) {
        const Pattern pattern(edge, whole_between(random, 1, relief.most_octaves), random);
        move_all([&](Index v, const Points& before) { return Point(pattern(before.row(v)) * normals(v, before)); });
    }
    for (int k = 0; k < lowerings && mean_angle(mesh, topology, positions) > most; ++k)
        positions = base + lower * (positions - base);
}

/// Twists or bends a surface, so that sharp edges become curved and flat faces too.
void bend(PolygonMesh& mesh, RandomNumbers& random)
{
    const double size = mesh.vertices.rowwise().norm().maxCoeff();
    const double wave = size * between(random, 0.8, 2.0);
    const double amplitude = wave * between(random, 0.05, 0.25);
    const double twist = between(random, -1.2, 1.2) / size;
    const bool twists = chance(random, 0.5);
    const GradientNoise motion(random);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point p = mesh.vertices.row(v);
        const double s = std::sin(twist * p.z());
        const double c = std::cos(twist * p.z());
        mesh.vertices.row(v) = twists ? Point(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z())
                                      : Point(p + amplitude * motion.vector(p / wave));
    }
}

/// Keeps the triangles on one side of a plane, if they are enough.
void cut_open(PolygonMesh& mesh, RandomNumbers& random)
{
    const Point direction = random_direction(random);
    const Eigen::VectorXd heights = mesh.vertices * direction.transpose();
    const double part = between(random, 0.15, 0.6);
    const double cut = (1.0 - part) * heights.minCoeff() + part * heights.maxCoeff();
    PolygonMesh kept;
    std::vector<Index> number(usize(mesh.n_vertices()), -1);
    std::vector<Index> vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        if (heights(corners).mean() < cut)
            continue;
        for (Index& v : corners) {
            if (number[v] < 0) {
                number[v] = static_cast<Index>(vertices.size());
                vertices.push_back(v);
            }
            v = number[v];
        }
        kept.add_face(corners);
    }
    if (kept.n_faces() < fewest_faces)
        return;
    kept.vertices = mesh.vertices(vertices, Eigen::all);
    mesh = std::move(kept);
}

/// A rectangle of triangles in a plane; each cell is cut along one diagonal.
PolygonMesh make_rectangle(RandomNumbers& random)
{
    const int n = whole_between(random, 30, 75);
    const int m = whole_between(random, 30, 75);
    const int diagonals = random.below(3);
    const double shift = chance(random, 0.5) ? between(random, 0.0, 0.25) : 0.0;
    PolygonMesh mesh;
    mesh.vertices.resize(Eigen::Index{n} * m, 3);
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const Point motion = shift * normal_vector(random);
            mesh.vertices.row(Eigen::Index{j} * n + i) = Point(i + motion.x(), j + motion.y(), 0.0);
        }
    for (int j = 0; j + 1 < m; ++j)
        for (int i = 0; i + 1 < n; ++i) {
            const Index v = j * n + i;
            const bool turned = diagonals == 1 ? (i + j) % 2 == 1 : diagonals == 2 && chance(random, 0.5);
            mesh.add_face(std::array{v, v + 1, turned ? v + n : v + n + 1});
            mesh.add_face(std::array{turned ? v + 1 : v, v + n + 1, v + n});
        }
    return mesh;
}

/// Raises rectangles and discs, whose walls are one row of triangles wide.
void raise_blocks(PolygonMesh& mesh, RandomNumbers& random)
{
    const Point size = mesh.vertices.colwise().maxCoeff();
    for (int k = whole_between(random, 1, 6); k > 0; --k) {
        const Point middle(between(random, 0.0, size.x()), between(random, 0.0, size.y()), 0.0);
        const Point half(between(random, 3.0, 20.0), between(random, 3.0, 20.0), 0.0);
        const bool round = chance(random, 0.3);
        const double turn = chance(random, 0.5) ? 0.0 : between(random, 0.0, std::numbers::pi);
        const double height = between(random, -8.0, 8.0);
        const double slope = chance(random, 0.3) ? between(random, -0.5, 0.5) : 0.0;
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const Point p = mesh.vertices.row(v) - middle;
            const double x = std::abs(std::cos(turn) * p.x() + std::sin(turn) * p.y()) / half.x();
            const double y = std::abs(std::cos(turn) * p.y() - std::sin(turn) * p.x()) / half.y();
            if (round ? x * x + y * y < 1.0 : std::max(x, y) < 1.0)
                mesh.vertices(v, 2) += height + slope * half.x() * (1.0 - x);
        }
    }
}

PolygonMesh make_height_field(RandomNumbers& random)
{
    PolygonMesh mesh = make_rectangle(random);
    add_relief(mesh, of_height_field, random);
    if (chance(random, 0.6))
        raise_blocks(mesh, random);
    return mesh;
}

/// A solid that may be bent. One in five is simple and large: most of its faces are far from any edge.
std::optional<PolygonMesh> make_part(RandomNumbers& random)
{
    SolidShape shape;
    if (chance(random, 0.2))
        shape = {.most_operations = 1, .may_have_grooves = false, .least_faces = 9'000, .most_faces = 20'000};
    std::optional<PolygonMesh> mesh = make_solid(shape, random);
    if (mesh && chance(random, 0.4))
        bend(*mesh, random);
    return mesh;
}

/// A smooth solid with patterns.
std::optional<PolygonMesh> make_body(const Relief& relief, RandomNumbers& random)
{
    SolidShape shape{.most_operations = 3, .sharp_angle = 60.0, .may_blur = true, .may_have_grooves = false};
    if (&relief == &rich) {
        shape.least_faces = 5'000;
        shape.most_faces = 14'000;
    }
    std::optional<PolygonMesh> mesh = make_solid(shape, random);
    if (mesh)
        add_relief(*mesh, relief, random);
    return mesh;
}

}  // namespace

std::optional<PolygonMesh> make_training_surface(std::uint32_t seed, int number)
{
    RandomNumbers random(mixed_bits(seed, static_cast<std::uint32_t>(number)));
    const int kind = number % 8;
    std::optional<PolygonMesh> mesh;
    if (kind == 7)
        mesh = make_height_field(random);
    else if (kind == 0 || kind == 3)
        mesh = make_part(random);
    else
        mesh = make_body(kind == 1 ? plain : kind == 4 ? calm : rich, random);
    if (!mesh)
        return mesh;
    if (kind == 6)
        decimate(*mesh, between(random, 0.15, 0.5));
    if (kind != 7 && chance(random, 0.25))
        cut_open(*mesh, random);
    const bool useful = mesh->n_faces() >= fewest_faces && mesh->vertices.allFinite() &&
                        mean_angle(*mesh, make_topology(*mesh), mesh->vertices) <= roughest;
    return useful ? mesh : std::nullopt;
}

}  // namespace seamflow
