#include "tests/support/random_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "partition/topology.h"
#include "tests/support/damage.h"
#include "tests/support/test_meshes.h"

namespace seamflow::test {

namespace {

/// Tells what is done to a mesh.
class Log {
  public:
    template <class... Parts>
    void add(const Parts&... parts)
    {
        text_ << (text_.tellp() > 0 ? ", " : "");
        (text_ << ... << parts);
    }
    [[nodiscard]] std::string text() const { return text_.str(); }

  private:
    std::ostringstream text_;
};

LooseMesh octahedron()
{
    LooseMesh mesh;
    mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

/// Vertices are added with flips between, which keeps valences apart.
LooseMesh sphere(RandomNumbers& random)
{
    LooseMesh mesh = octahedron();
    const int n = 4 + random.below(50);
    while (mesh.n_points() < n) {
        random.unit() < 0.5 ? split_face(mesh, random) : split_edge(mesh, random);
        for (int i = 0; i < 4; ++i)
            flip_edge(mesh, random);
        for (Point& point : mesh.points)
            point.normalize();
    }
    return mesh;
}

LooseMesh torus(RandomNumbers& random)
{
    const Index m = 3 + random.below(9);
    const Index n = 3 + random.below(6);
    return loosened(random.unit() < 0.3 ? quad_torus(m, n) : triangle_torus(m, n));
}

LooseMesh basic_surface(RandomNumbers& random, Log& log)
{
    const auto size = [&](Index least, Index range) { return least + random.below(range); };
    switch (random.below(8)) {
    case 0:
        log.add("torus");
        return torus(random);
    case 1: {
        log.add("tori glued together");
        LooseMesh mesh = torus(random);
        for (int handles = 1 + random.below(2); handles > 0; --handles)
            mesh = glued(mesh, torus(random), random);
        return mesh;
    }
    case 2:
        log.add("quad sheet");
        return loosened(quad_grid(size(2, 12), size(2, 10)));
    case 3:
        log.add("triangle sheet");
        return loosened(triangle_grid(size(2, 12), size(2, 10)));
    case 4:
        log.add("hexagon sheet");
        return loosened(hexagon_sheet(size(2, 7), size(2, 8)));
    case 5:
        log.add("tube");
        return loosened(cylinder(size(3, 10), size(1, 9)));
    case 6:
        log.add("Möbius band");
        return loosened(moebius_band(size(3, 12), size(3, 4)));
    default:
        log.add("sphere");
        return sphere(random);
    }
}

void change_connectivity(LooseMesh& mesh, RandomNumbers& random, Log& log)
{
    struct Change {
        const char* name;
        void (*apply)(LooseMesh&, RandomNumbers&);
        double part;
    };
    static constexpr std::array changes{
        Change{"flipped", flip_edge, 1.0},      Change{"split faces", split_face, 0.2},
        Change{"split edges", split_edge, 0.2}, Change{"split vertices", split_vertex, 0.1},
        Change{"cut", cut_face, 1.0},           Change{"merged", merge_faces, 0.7},
        Change{"holes", make_hole, 0.03}};
    for (int i = random.below(4); i > 0; --i) {
        const Change& change = changes.at(usize(random.below(static_cast<int>(changes.size()))));
        int times = 1 + static_cast<int>(random.unit() * change.part * mesh.n_faces());
        log.add(change.name, " ", times);
        for (; times > 0 && mesh.n_points() < 250; --times)
            change.apply(mesh, random);
    }
    if (random.unit() < 0.15) {
        LooseMesh dual = dual_of(mesh);
        if (dual.n_faces() > 0) {
            mesh = std::move(dual);
            log.add("dual");
        }
    }
}

double mean_edge(const LooseMesh& mesh)
{
    double sum = 0.0;
    std::size_t n = 0;
    for (const auto& face : mesh.faces)
        for (std::size_t k = 0; k < face.size(); ++k, ++n)
            sum += (mesh.points[face[k]] - mesh.points[face[(k + 1) % face.size()]]).norm();
    return sum / static_cast<double>(n);
}

void bend_and_shake(LooseMesh& mesh, RandomNumbers& random, Log& log)
{
    const double edge = mean_edge(mesh);
    const double wave = 0.5 * random.unit();
    const double noise = edge * (random.unit() < 0.1 ? 0.0 : std::pow(10.0, -3.0 + 2.5 * random.unit()));
    for (Point& point : mesh.points) {
        point.z() += wave * edge * std::sin(point.x() / edge) * std::cos(0.7 * point.y() / edge);
        point += noise * Point(random.symmetric(), random.symmetric(), random.symmetric());
    }
    log.add("noise ", noise / edge);
}

void transform(LooseMesh& mesh, RandomNumbers& random, Log& log)
{
    if (random.unit() < 0.2) {
        const double range = power_of_ten(-1.5, 1.5, random);
        log.add("stretched ", range);
        for (Point& point : mesh.points)
            point.x() *= range;
    }
    if (random.unit() < 0.3) {
        const Point axis(random.symmetric(), random.symmetric(), random.symmetric() + 2.0);
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(3.0 * random.unit(), axis.normalized().transpose()).toRotationMatrix();
        for (Point& point : mesh.points)
            point = (turn * point.transpose()).transpose().eval();
        log.add("turned");
    }
    const double scale = random.unit() < 0.5 ? 1.0 : power_of_ten(-6.0, 6.0, random);
    const double away = random.unit() < 0.7 ? 0.0 : power_of_ten(-1.0, 6.0, random);
    const Point offset = away * Point(random.symmetric(), random.symmetric(), random.symmetric());
    for (Point& point : mesh.points)
        point = scale * (point + offset);
    log.add("scale ", scale, ", offset ", away);
}

/// Only what can be told by edges and areas against the rest.
bool is_degenerate(const PolygonMesh& mesh, double edge)
{
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        if (!(vector_area(face, mesh.vertices).norm() > 1e-3 * edge * edge))
            return true;
        for (std::size_t k = 0; k < face.size(); ++k)
            if (!((mesh.vertices.row(face[k]) - mesh.vertices.row(face[(k + 1) % face.size()])).norm() > 0.02 * edge))
                return true;
    }
    return false;
}

bool is_manifold(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    return std::find(topology.kind.begin(), topology.kind.end(), VertexKind::NonManifold) == topology.kind.end();
}

PolygonMesh shuffled(const LooseMesh& mesh, RandomNumbers& random)
{
    LooseMesh turned = mesh;
    for (auto& face : turned.faces)
        std::rotate(face.begin(), face.begin() + random.below(static_cast<int>(face.size())), face.end());
    const auto new_vertex = random_permutation(mesh.n_points(), random);
    return renumbered(tightened(turned), new_vertex, random_permutation(mesh.n_faces(), random));
}

}  // namespace

RandomMesh random_mesh(RandomNumbers& random)
{
    Log log;
    LooseMesh mesh = basic_surface(random, log);
    change_connectivity(mesh, random, log);
    for (int more = random.unit() < 0.15 ? 1 + random.below(2) : 0; more > 0; --more) {
        LooseMesh other = basic_surface(random, log);
        change_connectivity(other, random, log);
        mesh = beside(std::move(mesh), other, Point(20.0, 0.0, 3.0 * more));
    }
    bend_and_shake(mesh, random, log);
    const bool hard = random.unit() < 0.4;
    for (int i = hard ? 1 + random.below(3) : 0; i > 0; --i)
        log.add(damage(mesh, random));
    if (random.unit() < 0.1) {
        mesh.points.emplace_back(random.symmetric(), random.symmetric(), random.symmetric());
        log.add("isolated vertex");
    }
    const double edge = mean_edge(mesh);
    const bool sound = !hard && !is_degenerate(tightened(mesh), edge) && is_manifold(tightened(mesh));
    transform(mesh, random, log);
    return {shuffled(mesh, random), log.text(), sound ? Soundness::Sound : Soundness::Hard};
}

std::vector<Index> random_permutation(Index n, RandomNumbers& random)
{
    std::vector<Index> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    // Not std::shuffle, which differs between libraries.
    for (Index i = n - 1; i > 0; --i)
        std::swap(numbers[i], numbers[random.below(i + 1)]);
    return numbers;
}

PolygonMesh renumbered(const PolygonMesh& mesh, const std::vector<Index>& new_vertex,
                       const std::vector<Index>& old_face)
{
    PolygonMesh result;
    result.vertices.resize(mesh.n_vertices(), 3);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        result.vertices.row(new_vertex[v]) = mesh.vertices.row(v);
    for (const Index f : old_face) {
        std::vector<Index> corners;
        for (const Index v : mesh.face(f))
            corners.push_back(new_vertex[v]);
        result.add_face(corners);
    }
    return result;
}

ShuffledMesh shuffled(const PolygonMesh& mesh, std::uint32_t seed)
{
    RandomNumbers random(seed);
    ShuffledMesh result{{}, random_permutation(mesh.n_vertices(), random)};
    result.mesh = renumbered(mesh, result.new_vertex, random_permutation(mesh.n_faces(), random));
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto corners = result.mesh.face_vertices.begin();
        const Index begin = result.mesh.face_offsets[f];
        const Index end = result.mesh.face_offsets[f + 1];
        std::rotate(corners + begin, corners + begin + random.below(end - begin), corners + end);
    }
    return result;
}

std::vector<Index> random_cut(const PolygonMesh& mesh, Index k, RandomNumbers& random)
{
    if (random.unit() < 0.25)
        return random_labels(mesh.n_faces(), k, static_cast<std::uint32_t>(random.below(1 << 30)));
    // The nearest of k faces, by distances that differ from region to region.
    std::vector<Point> seeds;
    std::vector<double> weight;
    const auto middle = [&](Index f) { return Point(mesh.vertices.row(mesh.face(f)[0])); };
    for (Index i = 0; i < k; ++i) {
        seeds.push_back(middle(random.below(mesh.n_faces())));
        weight.push_back(0.5 + random.unit());
    }
    std::vector<Index> labels;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        Index nearest = 0;
        for (Index i = 1; i < k; ++i)
            if (weight[i] * (middle(f) - seeds[i]).norm() < weight[nearest] * (middle(f) - seeds[nearest]).norm())
                nearest = i;
        labels.push_back(nearest);
    }
    return labels;
}

}  // namespace seamflow::test
