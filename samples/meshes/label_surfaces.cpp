#include "samples/meshes/label_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "samples/meshes/building.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

/// Goes through the cubes layer by layer, with the labels and the vertices of two layers in memory.
class LayeredFaces {
  public:
    LayeredFaces(Index size, const Labels& label)
        : size_(size)
        , label_(label)
        , below_(usize((size + 1) * (size + 1)), -1)
        , labels_(below_)
    {
        vertices_.fill(std::vector<Index>(below_.size(), -1));
    }

    LabelSurface make()
    {
        for (Index layer = 0; layer < size_; ++layer)
            add_layer(layer);
        surface_.mesh.vertices.resize(static_cast<Index>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            surface_.mesh.vertices.row(static_cast<Index>(v)) = positions_[v];
        return std::move(surface_);
    }

  private:
    using Cube = std::array<Index, 3>;

    [[nodiscard]] std::size_t place(Index j, Index k) const { return usize(j * (size_ + 1) + k); }

    void add_layer(Index i)
    {
        std::swap(below_, labels_);
        std::ranges::fill(vertices_[usize((i + 1) % 2)], -1);
        for (Index j = 0; j < size_; ++j)
            for (Index k = 0; k < size_; ++k)
                labels_[place(j + 1, k + 1)] = label_(Point(i + 0.5, j + 0.5, k + 0.5));
        for (Index j = 0; j < size_; ++j)
            for (Index k = 0; k < size_; ++k) {
                const Index own = labels_[place(j + 1, k + 1)];
                add_between(below_[place(j + 1, k + 1)], own, {i, j, k}, 0);
                add_between(labels_[place(j, k + 1)], own, {i, j, k}, 1);
                add_between(labels_[place(j + 1, k)], own, {i, j, k}, 2);
            }
    }

    void add_between(Index below, Index above, const Cube& cube, std::size_t axis)
    {
        if (below == above || below < 0 || above < 0)
            return;
        std::array corner{cube, cube, cube, cube};
        ++corner[1][(axis + 1) % 3];
        ++corner[2][(axis + 1) % 3];
        ++corner[2][(axis + 2) % 3];
        ++corner[3][(axis + 2) % 3];
        std::array<Index, 4> face{};
        for (std::size_t k = 0; k < 4; ++k)
            face[above < below ? k : 3 - k] = vertex(corner[k]);
        surface_.mesh.add_face(face);
        surface_.front.push_back(std::min(below, above));
        surface_.back.push_back(std::max(below, above));
    }

    Index vertex(const Cube& corner)
    {
        Index& v = vertices_[usize(corner[0] % 2)][place(corner[1], corner[2])];
        if (v < 0) {
            v = static_cast<Index>(positions_.size());
            positions_.emplace_back(corner[0], corner[1], corner[2]);
        }
        return v;
    }

    Index size_;
    const Labels& label_;
    /// Of the cubes of a layer, from 1 in both directions; -1 at 0.
    std::vector<Index> below_;
    std::vector<Index> labels_;
    /// The vertices in the planes below and above a layer, by parity.
    std::array<std::vector<Index>, 2> vertices_;
    std::vector<Point> positions_;
    LabelSurface surface_;
};

/// The seed nearest to a point, from 1, if its distance is below `reach`; else 0.
Labels nearest_of(std::vector<Point> seeds, double reach = std::numeric_limits<double>::infinity())
{
    return [seeds = std::move(seeds), reach](const Point& point) {
        Index nearest = 0;
        double least = reach * reach;
        for (std::size_t i = 0; i < seeds.size(); ++i)
            if (const double squared = (point - seeds[i]).squaredNorm(); squared < least) {
                least = squared;
                nearest = static_cast<Index>(i) + 1;
            }
        return nearest;
    };
}

/// The quads with `steps` cubes along an edge of the unit cube.
LabelSurface at_resolution(const Labels& labels, double steps)
{
    LabelSurface surface =
        faces_between(static_cast<Index>(std::ceil(steps)), [&](const Point& point) { return labels(point / steps); });
    surface.mesh.vertices /= steps;
    return surface;
}

/// The resolution at which the number of vertices, which grows nearly with its square, is about the one wanted.
double choose_steps(const Labels& labels, Index wanted)
{
    double best = 0.0;
    double least = std::numeric_limits<double>::infinity();
    double steps = 16.0;
    for (int trial = 0; trial < 16 && least > 0.03; ++trial) {
        const double ratio =
            static_cast<double>(wanted) / std::max(Index{1}, at_resolution(labels, steps).mesh.n_vertices());
        if (const double off = std::abs(ratio - 1.0); off < least) {
            least = off;
            best = steps;
        }
        // Small meshes grow in jumps.
        steps *= std::pow(ratio, trial < 4 ? 0.5 : 0.2);
    }
    return best;
}

}  // namespace

LabelSurface faces_between(Index size, const Labels& label)
{
    return LayeredFaces(size, label).make();
}

LabelSurface cut_into_triangles(const LabelSurface& quads)
{
    LabelSurface cut;
    cut.mesh.vertices = quads.mesh.vertices;
    for (Index f = 0; f < quads.mesh.n_faces(); ++f) {
        const auto q = quads.mesh.face(f);
        add_face(cut.mesh, {q[0], q[1], q[2]});
        add_face(cut.mesh, {q[0], q[2], q[3]});
        cut.front.insert(cut.front.end(), 2, quads.front[f]);
        cut.back.insert(cut.back.end(), 2, quads.back[f]);
    }
    return cut;
}

Labels two_balls(std::uint32_t /*seed*/)
{
    return nearest_of({{0.5, 0.5, 0.32}, {0.5, 0.5, 0.68}}, 0.24);
}

Labels three_bubbles(std::uint32_t /*seed*/)
{
    std::vector<Point> centres;
    for (const double angle : {0.2, 0.2 + 2.0 / 3.0 * std::numbers::pi, 0.2 + 4.0 / 3.0 * std::numbers::pi})
        centres.emplace_back(0.5 + 0.17 * std::cos(angle), 0.5 + 0.17 * std::sin(angle), 0.5);
    return nearest_of(centres, 0.25);
}

Labels honeycomb(std::uint32_t /*seed*/)
{
    // A hexagonal lattice whose rows are turned against the axes.
    std::vector<Point> centres;
    for (int row = -5; row <= 5; ++row)
        for (int column = -5; column <= 5; ++column) {
            const double x = 0.26 * (column + 0.5 * (row % 2));
            const double y = 0.26 * std::sqrt(0.75) * row;
            centres.emplace_back(0.5 + 0.96 * x - 0.28 * y, 0.5 + 0.28 * x + 0.96 * y, 0.5);
        }
    return nearest_of(centres);
}

Labels plates_of_a_t(std::uint32_t /*seed*/)
{
    return [](const Point& point) {
        const double x = 0.96 * (point[0] - 0.47) + 0.28 * (point[1] - 0.61);
        const double y = 0.96 * (point[1] - 0.61) - 0.28 * (point[0] - 0.47);
        return y > 0.0 ? Index{1} : x < 0.0 ? Index{2} : Index{3};
    };
}

Labels foam_of(int n_cells, std::uint32_t seed)
{
    RandomNumbers random(seed);
    std::vector<Point> seeds(usize(n_cells));
    for (Point& point : seeds)
        for (double& coordinate : point)
            coordinate = 0.5 + 0.4 * random.symmetric();
    return [cell = nearest_of(seeds)](const Point& point) {
        return ((point.array() - 0.5).abs() < 0.45).all() ? cell(point) : 0;
    };
}

Labels foam(std::uint32_t seed)
{
    return foam_of(24, seed);
}

LabelSurface make_label_surface(const Labels& labels, Index vertices, double noise, std::uint32_t seed)
{
    require_between("the number of vertices", vertices, fewest_vertices_of_labels, most_vertices_of_labels);
    require_between("noise", noise, 0.0, 1e6);
    const double steps = choose_steps(labels, vertices);
    LabelSurface surface = at_resolution(labels, steps);
    RandomNumbers random(seed);
    // Half an edge away from the boundary.
    const double end = (std::ceil(steps) - 0.5) / steps;
    Points& positions = surface.mesh.vertices;
    for (Index v = 0; v < positions.rows(); ++v)
        if ((positions.row(v).array() > 0.5 / steps && positions.row(v).array() < end).all())
            for (double& coordinate : positions.row(v))
                coordinate += noise / steps * random.symmetric();
    return surface;
}

}  // namespace seamflow
