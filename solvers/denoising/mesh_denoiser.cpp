#include "solvers/denoising/mesh_denoiser.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"
#include "solvers/denoising/filter_sample.h"
#include "solvers/denoising/mesh_piece.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/smoother_places.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// The most relaxation of vertices along the surface, as for edges that are kept.
constexpr double most_relaxation = 0.1;
/// The standard deviation of the noise over that of the motions: some noise stays. Measured on eight surfaces of the
/// literature with noise of 0.2 to 0.47 mean edges, where it was 1.03 to 1.065.
constexpr double noise_by_motion = 1.045;

/// The mean chord between faces and their wanted normals.
double mean_chord(const PolygonMesh& mesh, const Points& positions, const Points& wanted, const Executor& exec)
{
    const double total = sum(exec, mesh.n_faces(), [&](Index f) {
        const double length = area_above_rounding(mesh.face(f), positions);
        return length > 0.0 ? (vector_area(mesh.face(f), positions) / length - wanted.row(f)).norm() : 0.0;
    });
    return total / std::max(mesh.n_faces(), Index{1});
}

double mean_squared_edge(const PolygonMesh& mesh, const Topology& topology, Index v, const Points& positions)
{
    const auto corners = topology.corners_at(v);
    double total = 0.0;
    for (const Index corner : corners)
        total += (positions.row(mesh.face_vertices[topology.next(mesh, corner)]) - positions.row(v)).squaredNorm();
    return total / static_cast<double>(corners.size());
}

}  // namespace

MeshDenoiser::MeshDenoiser(const PolygonMesh& mesh, const Topology& topology, const Executor& exec,
                           std::optional<double> edge_angle, bool as_one)
    : triangles_(cut_polygons(mesh, topology, exec))
    , polygons_(&mesh)
    , polygon_topology_(&topology)
    , mesh_(triangles_ ? &triangles_->mesh : &mesh)
    , topology_(triangles_ ? &triangles_->topology : &topology)
    , places_(*mesh_, *topology_, as_one)
    , rims_(*mesh_, *topology_)
    , edge_angle_(edge_angle)
{
}

std::unique_ptr<const MeshDenoiser::Triangles>
MeshDenoiser::cut_polygons(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    constexpr Index corners = 3;
    if (mesh.n_corners() == corners * mesh.n_faces())
        return nullptr;
    auto cut = std::make_unique<Triangles>();
    cut->mesh.vertices = mesh.vertices;
    for (const Triangle& triangle : triangulate(mesh))
        cut->mesh.add_face(triangle);
    cut->topology = make_topology(cut->mesh, exec);
    cut->topology.kind = topology.kind;
    cut->topology.fixed = topology.fixed;
    return cut;
}

Points MeshDenoiser::denoise(const Points& before, std::span<const double> strengths, const Executor& exec)
{
    spikes_ = find_spikes(*polygons_, before, exec);
    Points positions = without_noise(without_spikes(*polygons_, *polygon_topology_, spikes_, before), strengths, exec);
    for (const Spike& spike : spikes_)
        positions.row(spike.vertex) = before.row(spike.vertex);
    return positions;
}

Points MeshDenoiser::without_noise(const Points& before, std::span<const double> strengths, const Executor& exec)
{
    const DenoisedNormals found = denoise_normals(*mesh_, *topology_, before, exec);
    Points fitted = before;
    fit_vertices(*mesh_, *topology_, {},
                 {found.normals, std::min(most_relaxation, mean_chord(*mesh_, before, found.normals, exec))}, fitted,
                 exec);
    const std::vector<std::uint8_t> is_flat = flat_vertices(*mesh_, *topology_, before, exec);
    std::vector<double> parts = places_.find(*mesh_, *topology_, before, fitted, found, is_flat, exec);
    measure_noise(fitted - before, parts, is_flat, found.normals, fitted, exec);
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        if (!strengths.empty())
            parts[v] *= strengths[v];
        if (parts[v] < 1.0)
            fitted.row(v) = before.row(v) + parts[v] * (fitted.row(v) - before.row(v));
    });
    Points result = along_normals(*mesh_, *topology_, before, fitted, found.normals, exec);
    rims_.apply(*topology_, found.normals, parts, result);
    if (edge_angle_)
        take_smoother_places({*mesh_, *topology_, before, found.normals, parts}, places_.components(), *edge_angle_,
                             result, exec);
    keep_facing(*mesh_, *topology_, before, found.normals, result, exec);
    return result;
}

void MeshDenoiser::measure_noise(const Points& motions, std::span<const double> parts,
                                 std::span<const std::uint8_t> is_flat, const Points& normals, const Points& after,
                                 const Executor& exec)
{
    // Squares of motions and of edges, and the numbers of vertices with noise and of all on faces.
    using Sums = Eigen::Array4d;
    const Sums sums = sum(
        exec, mesh_->n_vertices(),
        [&](Index v) -> Sums {
            if (topology_->corners_at(v).empty())
                return Sums::Zero();
            if (parts[v] <= 0.0 || is_flat[v] != 0)
                return Sums(0.0, 0.0, 0.0, 1.0);
            const double motion = motion_along_normal(*topology_, normals, v, motions.row(v));
            return Sums(motion * motion, mean_squared_edge(*polygons_, *polygon_topology_, v, after), 1.0, 1.0);
        },
        Sums(Sums::Zero()));
    noise_ = sums[2] > 0.0 ? SurfaceNoise{noise_by_motion * std::sqrt(sums[0] / sums[2]), std::sqrt(sums[1] / sums[2]),
                                          sums[2] / sums[3]}
                           : SurfaceNoise{};
}

SurfaceNoise measure_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const auto measured = [&](const PolygonMesh& part, const Topology& of_part, bool as_one) {
        MeshDenoiser denoiser(part, of_part, exec, {}, as_one);
        denoiser.denoise(part.vertices, {}, exec);
        return denoiser.noise();
    };
    const FilterSample sample = take_filter_sample(mesh, topology, exec);
    if (static_cast<Index>(sample.vertices.size()) == mesh.n_vertices())
        return measured(mesh, topology, false);
    const PolygonMesh patches = cut_out(mesh, topology, mesh.vertices, faces_of(sample, mesh, exec), exec).mesh;
    return measured(patches, make_topology(patches, exec), true);
}

}  // namespace seamflow
