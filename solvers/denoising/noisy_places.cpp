#include "solvers/denoising/noisy_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>

#include "partition/vector_area.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

namespace {

// Lengths are in lengths of the edges at the vertex. Measured on surfaces that are known, without noise and with noise
// of 0.03 to 0.5.

/// The median of the motions is larger where there is noise, and the correlation of motions at neighbouring vertices is
/// less: that of noise was -0.11 to 0.03, and up to 0.18 on scans whose noise is alike at neighbours; that of details
/// that were taken for noise was 0.12 and more, with medians of 0.005 and less. So a small median needs a smaller
/// correlation.
constexpr float least_median = 0.004F;
constexpr float clear_median = 0.009F;
constexpr double most_correlation_of_little = 0.06;
constexpr double most_correlation = 0.28;
/// Around spikes it is large, too: so it may be that of faces whose vertices move by less than a few medians.
constexpr double most_calm_correlation = 0.15;
constexpr float most_medians = 10.0F;
/// Noise that leaves no doubt, as the median over the faces: it may be alike at neighbours, too.
constexpr float much_noise = 0.16F;
constexpr std::size_t fewest_without_doubt = 1000;
/// With fewer triangles nothing can be told.
constexpr std::size_t fewest_faces = 200;
constexpr std::size_t fewest_faces_if_thinned = 1000;
/// Modelled surfaces of few triangles, such as cages of subdivision surfaces, bend like noise. Their motions had
/// correlations of 0.1 to 0.2, or medians of less than this part of the noise that was estimated.
constexpr std::size_t few_faces = 10'000;
constexpr float least_part_of_noise = 0.2F;
/// Larger correlations are those of noise that is alike at neighbours, and so are medians of a smaller part of the
/// noise that was estimated.
constexpr double most_correlation_of_white = 0.1;
constexpr float least_part_if_white = 0.35F;
/// On thinned surfaces, which bend more from vertex to vertex than they were made to, only clear noise counts: its
/// medians were 0.011 and more and 0.32 to 0.5 of the noise that was estimated, its correlations up to 0.09; those of
/// wrinkles, voxels and mouldings up to 0.035, 0.46 and 0.14 to 0.5, or 0.094 and more.
constexpr float least_part_if_thinned = 0.25F;
constexpr double most_correlation_if_thinned = 0.09;
/// Squared chord of normals that are equal up to rounding.
constexpr double same_normal = 1e-12;
/// The mean motion around a vertex up to which it stays, and from which on it goes all the way.
constexpr float calm = 0.002F;
constexpr float restless = 0.005F;
constexpr int rounds = 24;

template <class Number>
Number middle_of(std::vector<Number>& numbers)
{
    const auto middle = numbers.begin() + std::ssize(numbers) / 2;
    std::ranges::nth_element(numbers, middle);
    return *middle;
}

/// From 0 to 1 without a bend at either end.
double smooth_step(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Motions of vertices, in lengths of the edges there.
struct Motion {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& before;
    const Points& after;
    const DenoisedNormals& found;
    /// #V: along the normal, without sign.
    std::vector<float> lengths;
    /// #V: the mean length of the edges, in length.
    std::vector<double> edges;

    Motion(const PolygonMesh& of_mesh, const Topology& of_topology, const Points& from, const Points& to,
           const DenoisedNormals& normals, const Executor& exec)
        : mesh(of_mesh)
        , topology(of_topology)
        , before(from)
        , after(to)
        , found(normals)
        , lengths(usize(of_mesh.n_vertices()), 0.0F)
        , edges(edge_lengths_at_vertices(of_mesh, of_topology, from, exec))
    {
        for_each(exec, mesh.n_vertices(), [&](Index v) {
            if (edges[v] > 0.0)
                lengths[v] = static_cast<float>(
                    motion_along_normal(topology, found.normals, v, after.row(v) - before.row(v)) / edges[v]);
        });
    }

    /// The sums over the edges of a face of products of the motions at both ends, and over its corners of squares.
    [[nodiscard]] Eigen::Array2d products(Index f) const
    {
        const auto along_normal = [&](Index v) {
            const double length = (after.row(v) - before.row(v)).dot(found.normals.row(f));
            return edges[v] > 0.0 ? length / edges[v] : 0.0;
        };
        const auto corners = mesh.face(f);
        Eigen::Array2d sums = Eigen::Array2d::Zero();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const double here = along_normal(corners[k]);
            sums += Eigen::Array2d(here * along_normal(corners[k + 1 < corners.size() ? k + 1 : 0]), here * here);
        }
        return sums;
    }
};

Components all_together(const PolygonMesh& mesh)
{
    Components all;
    all.component_of.assign(usize(mesh.n_faces()), 0);
    all.nodes.values.resize(usize(mesh.n_faces()));
    std::iota(all.nodes.values.begin(), all.nodes.values.end(), Index{0});
    all.nodes.close();
    return all;
}

/// @param of_component its faces. @param is_flat #V: see flat_vertices.
NoiseKind kind_of_noise(const Motion& motion, std::span<const Index> of_component,
                        std::span<const std::uint8_t> is_flat, bool is_thinned)
{
    std::vector<Index> faces;
    std::ranges::copy_if(of_component, std::back_inserter(faces), [&](Index f) {
        return std::ranges::any_of(motion.mesh.face(f), [&](Index v) { return is_flat[v] == 0; });
    });
    if (faces.size() < (is_thinned ? fewest_faces_if_thinned : fewest_faces))
        return NoiseKind::None;
    std::vector<float> of_vertices;
    std::vector<float> of_faces;
    for (const Index f : faces) {
        of_faces.push_back(motion.found.noise[f]);
        for (const Index v : motion.mesh.face(f))
            if (motion.topology.moves(v))
                of_vertices.push_back(motion.lengths[v]);
    }
    if (of_vertices.empty())
        return NoiseKind::None;
    const float noise = middle_of(of_faces);
    const float median = middle_of(of_vertices);
    const bool is_without_doubt = noise > much_noise && faces.size() >= fewest_without_doubt && !is_thinned;
    if (!is_without_doubt && median <= (is_thinned ? clear_median : least_median))
        return NoiseKind::None;
    Eigen::Array2d all = Eigen::Array2d::Zero();
    Eigen::Array2d of_calm = Eigen::Array2d::Zero();
    for (const Index f : faces) {
        const Eigen::Array2d of_face = motion.products(f);
        all += of_face;
        if (std::ranges::none_of(motion.mesh.face(f),
                                 [&](Index v) { return motion.lengths[v] > most_medians * median; }))
            of_calm += of_face;
    }
    const auto is_below = [](const Eigen::Array2d& sums, double correlation) {
        return sums[0] < correlation * sums[1];
    };
    const bool is_white =
        is_below(all, most_correlation_of_white) && (noise > much_noise || median >= least_part_if_white * noise);
    const NoiseKind kind = is_white ? NoiseKind::White : NoiseKind::Alike;
    if (is_without_doubt)
        return kind;
    if (is_thinned)
        return median >= least_part_if_thinned * noise && is_below(all, most_correlation_if_thinned) ? kind
                                                                                                     : NoiseKind::None;
    if (faces.size() < few_faces && median < least_part_of_noise * noise)
        return NoiseKind::None;
    const bool is_noise = median <= clear_median || faces.size() < few_faces
                              ? is_below(all, most_correlation_of_little)
                              : is_below(all, most_correlation) || is_below(of_calm, most_calm_correlation);
    return is_noise ? kind : NoiseKind::None;
}

}  // namespace

std::vector<std::uint8_t> flat_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                        const Executor& exec)
{
    const auto normal_at = [&](Index corner) {
        return Point(vector_area(mesh.face(topology.face_of[corner]), positions).stableNormalized());
    };
    std::vector<std::uint8_t> is_flat(usize(mesh.n_vertices()));
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const auto corners = topology.corners_at(v);
        const Point first = corners.empty() ? Point(Point::Zero()) : normal_at(corners[0]);
        const auto is_like_first = [&](Index corner) {
            // Faces need not be oriented alike.
            const Point n = normal_at(corner);
            return std::min((n - first).squaredNorm(), (n + first).squaredNorm()) <= same_normal;
        };
        is_flat[v] = std::ranges::all_of(corners, is_like_first) ? 1 : 0;
    });
    return is_flat;
}

NoisyPlaces::NoisyPlaces(const PolygonMesh& mesh, const Topology& topology, bool as_one, bool is_thinned)
    : components_(as_one ? all_together(mesh) : face_components(mesh, topology))
    , is_thinned_(is_thinned)
{
}

NoisyPlaces::Found NoisyPlaces::find(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                                     const Points& after, const DenoisedNormals& found,
                                     std::span<const std::uint8_t> is_flat, const Executor& exec) const
{
    const Index n = mesh.n_vertices();
    const Motion motion(mesh, topology, before, after, found, exec);
    Found result{std::vector<double>(usize(n), 0.0), std::vector<NoiseKind>(usize(components_.count()))};
    for_each(exec, components_.count(),
             [&](Index c) { result.kinds[c] = kind_of_noise(motion, components_.nodes[c], is_flat, is_thinned_); });
    VertexAverages::Rows near(mesh.n_faces(), 1);
    VertexAverages::Rows around(mesh.n_faces(), 1);
    for_each(exec, mesh.n_faces(), [&](Index f) {
        near(f, 0) = 0.0F;
        for (const Index v : mesh.face(f))
            near(f, 0) += motion.lengths[v] / static_cast<float>(mesh.face(f).size());
    });
    VertexAverages(mesh, topology, exec).spread(near, around, 0, rounds, exec);
    for_each(exec, n, [&](Index v) {
        const auto corners = topology.corners_at(v);
        const auto count = static_cast<double>(corners.size());
        for (const Index corner : corners) {
            const Index f = topology.face_of[corner];
            if (result.kinds[components_.component_of[f]] != NoiseKind::None)
                result.parts[v] += smooth_step((around(f, 0) - calm) / (restless - calm)) / count;
        }
    });
    return result;
}

}  // namespace seamflow
