#include "solvers/denoising/mesh_denoiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"
#include "solvers/denoising/correlated_noise.h"
#include "solvers/denoising/filter_sample.h"
#include "solvers/denoising/flatter_normals.h"
#include "solvers/denoising/mesh_piece.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/smoother_places.h"
#include "solvers/denoising/thinned_mesh.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/normals/face_neighbours.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// The most relaxation of vertices along the surface, as in fit_vertices.
constexpr double most_relaxation = 0.1;
/// The standard deviation of the noise over the standard deviation of the motions. It is above 1 because some noise
/// stays. Eight surfaces of the literature with noise of 0.2 to 0.47 mean edges had 1.03 to 1.065.
constexpr double noise_by_motion = 1.045;

/// After much noise, one fit does not reach the wanted normals. Vertices are fitted again, at most so often, until the
/// mean chord between faces and wanted normals is this small. Below it, a sphere with sharp edges lost by further
/// fits.
constexpr int most_further_fits = 3;
constexpr double near_enough = 0.04;

/// The most times that a mesh is thinned, one time after another; the fewest faces of a component that is thinned; and
/// the number of thinned meshes each time: nearly all vertices are in one of these, most are in two. (Ten meshes gave
/// results no nearer to the truth.)
constexpr int most_thinned = 2;
constexpr Index fewest_to_thin = 3000;
constexpr int rounds_of_thinning = 6;
/// The evidence on a mesh thinned once that proves noise where the whole mesh has Correlation::Possible. No clean
/// surface with this had more than 2.5 (thinned twice: 0.9, see NoisyPlaces).
constexpr float proof_by_thinned = 3.0F;
/// At doubtful vertices (Correlation::Doubtful), local fits are used only if CorrelatedNoise::least_risk, relative to
/// the risk of leaving the surface as it is, is below the first number, and the standard deviation of the noise above
/// the second, in edges. Reliefs under white noise with so little risk had a deviation of 0.1 at most.
constexpr double clear_risk = 0.45;
constexpr double clear_deviation = 0.15;

/// The mean chord between faces and their wanted normals.
double mean_chord(const PolygonMesh& mesh, const Points& positions, const Points& wanted, const Executor& exec)
{
    const double total = sum(exec, mesh.n_faces(), [&](Index f) {
        const double length = area_above_rounding(mesh.face(f), positions);
        return length > 0.0 ? (vector_area(mesh.face(f), positions) / length - wanted.row(f)).norm() : 0.0;
    });
    return total / std::max(mesh.n_faces(), Index{1});
}

/// The mean squared length of the edges at vertex v, one edge per face.
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
                           std::optional<double> edge_angle, bool as_one, int n_thinned, float least_evidence)
    : triangles_(cut_polygons(mesh, topology, exec))
    , polygons_(&mesh)
    , polygon_topology_(&topology)
    , mesh_(triangles_ ? &triangles_->mesh : &mesh)
    , topology_(triangles_ ? &triangles_->topology : &topology)
    , signs_(face_signs(*mesh_, *topology_))
    , averages_(*mesh_, *topology_, exec)
    , places_(*mesh_, *topology_, as_one, n_thinned, least_evidence)
    , rims_(*mesh_, *topology_)
    , edge_angle_(edge_angle)
    , as_one_(as_one)
    , n_thinned_(n_thinned)
{
    if (signs_.empty())
        return;
    oriented_ = *mesh_;
    for (Index f = 0; f < mesh_->n_faces(); ++f)
        if (signs_[f] < 0)
            std::reverse(oriented_.face_vertices.begin() + oriented_.face_offsets[f],
                         oriented_.face_vertices.begin() + oriented_.face_offsets[f + 1]);
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
    if (!topology.junctions.empty())
        free_junctions(cut->mesh, cut->topology, exec);
    cut->topology.kind = topology.kind;
    cut->topology.fixed = topology.fixed;
    return cut;
}

Points MeshDenoiser::denoise(const Points& before, std::span<const double> strengths, const Executor& exec)
{
    spikes_ = find_spikes(*polygons_, before, exec);
    Points positions = without_noise(without_spikes(*polygons_, *polygon_topology_, spikes_, before), strengths, exec);
    if (spikes_.empty())
        return positions;
    for (const Spike& spike : spikes_)
        positions.row(spike.vertex) = before.row(spike.vertex);
    // Spikes that are put back can fold the faces around them. No normals are wanted (0): only folded faces matter.
    keep_all_facing(before, Points::Zero(mesh_->n_faces(), 3), positions, exec);
    return positions;
}

MeshDenoiser::Findings MeshDenoiser::examine(const Points& before, const Executor& exec) const
{
    Findings found{
        denoise_normals(*mesh_, *topology_, before, exec), before, flat_vertices(*mesh_, *topology_, before, exec), {}};
    const Points& normals = found.normals.normals;
    fit(normals, mean_chord(*mesh_, before, normals, exec), found.fitted, exec);
    found.places = places_.find(denoised(before, found), exec);
    return found;
}

NoisyPlaces::Denoised MeshDenoiser::denoised(const Points& before, const Findings& found) const
{
    return {*mesh_, *topology_, averages_, before, found.fitted, found.normals, found.is_flat};
}

std::vector<PlaceStatistics> MeshDenoiser::measure_places(Index most, const Executor& exec) const
{
    const Points& before = mesh_->vertices;
    const Findings found = examine(before, exec);
    const std::vector<Index> all = spread_places(*topology_, averages_.neighbours(), before, rings_between_places);
    const std::size_t n = std::min(all.size(), usize(most));
    std::vector<Index> places;
    for (std::size_t i = 0; i < n; ++i)
        places.push_back(all[i * all.size() / n]);
    return seamflow::measure_places(denoised(before, found), places, exec);
}

Points MeshDenoiser::without_noise(const Points& before, std::span<const double> strengths, const Executor& exec)
{
    const auto strength = [&](Index v) { return strengths.empty() ? 1.0 : strengths[v]; };
    Findings found = examine(before, exec);
    Points begun = before;
    if (const std::optional<Points> without = without_correlated_noise(before, found.places, exec)) {
        for_each(exec, mesh_->n_vertices(),
                 [&](Index v) { begun.row(v) += strength(v) * (without->row(v) - before.row(v)); });
        keep_all_facing(before, found.normals.normals, begun, exec);
        found = examine(begun, exec);
    }
    const KeptStructure kept = n_thinned_ == 0 ? put_back_structure(before, begun, found, exec) : KeptStructure{};
    const Points& normals = found.normals.normals;
    if (n_thinned_ == 0 && std::ranges::any_of(found.places.shares, [](double share) { return share > 0.0; }))
        improve_fit(begun, found, exec);
    std::vector<double>& shares = found.places.shares;
    Points& fitted = found.fitted;
    std::vector<double> has_noise = shares;
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        if (begun.row(v) != before.row(v))
            has_noise[v] = 1.0;
    });
    measure_noise(fitted - before, has_noise, found.is_flat, normals, fitted, exec);
    noise_.kept = kept;
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        shares[v] *= strength(v);
        if (shares[v] < 1.0)
            fitted.row(v) = begun.row(v) + shares[v] * (fitted.row(v) - begun.row(v));
    });
    Points result = along_normals(*mesh_, *topology_, begun, fitted, normals, exec);
    if (edge_angle_)
        take_smoother_places({*mesh_, *topology_, begun, normals, shares}, places_.components(), *edge_angle_, result,
                             exec);
    // The rims of thinned meshes are jagged because vertices were left out.
    if (n_thinned_ == 0 && !keeps_rims_) {
        const Points motions = rims_.motions(*mesh_, *topology_, normals, shares, before);
        for_each(exec, mesh_->n_vertices(), [&](Index v) {
            if (!motions.row(v).isZero(0.0))
                result.row(v) += strength(v) * motions.row(v);
        });
        noise_.rim_vertices = sum(exec, mesh_->n_vertices(), [&](Index v) {
            return topology_->kind[v] == VertexKind::Boundary && !motions.row(v).isZero(0.0) ? 1.0 : 0.0;
        });
    }
    keep_all_facing(before, normals, result, exec);
    return result;
}

std::optional<Points> MeshDenoiser::without_correlated_noise(const Points& before, const NoisyPlaces::Found& places,
                                                             const Executor& exec) const
{
    if (n_thinned_ >= most_thinned)
        return {};
    const Components& components = places_.components();
    using Correlation = NoisyPlaces::Correlation;
    // For thinned meshes; nothing in small components.
    std::vector<Correlation> left_to_do(places.correlated.size(), Correlation::None);
    for (Index c = 0; c < components.count(); ++c)
        if (components.nodes[c].size() >= usize(fewest_to_thin))
            for (const Index f : components.nodes[c])
                for (const Index v : mesh_->face(f))
                    left_to_do[v] = places.correlated[v];
    if (std::ranges::all_of(left_to_do, [](Correlation one) { return one == Correlation::None; }))
        return {};
    Points result = before;
    // Local fits are tried first, on a mesh that is not thinned, at vertices that have other noise as well. Doubtful: a
    // fit is taken only if it is clearly noise, otherwise the vertex stays. Found: it is taken if the noise is
    // plausible.
    std::vector<std::uint8_t> is_fitted(left_to_do.size(), 0);
    for (std::size_t v = 0; v < left_to_do.size() && n_thinned_ == 0; ++v)
        is_fitted[v] =
            (left_to_do[v] == Correlation::Found || left_to_do[v] == Correlation::Doubtful) && places.shares[v] > 0.0
                ? 1
                : 0;
    if (std::ranges::find(is_fitted, 1) != is_fitted.end()) {
        const CorrelatedNoise noise(*mesh_, *topology_, averages_, signs_, before, exec);
        const std::optional<Points> without = noise.is_plausible() ? std::optional(noise.without(exec)) : std::nullopt;
        const bool is_clear = without && noise.least_risk() < clear_risk && noise.deviation() > clear_deviation;
        for_each(exec, mesh_->n_vertices(), [&](Index v) {
            if (is_fitted[v] == 0)
                return;
            const bool is_doubtful = left_to_do[v] == Correlation::Doubtful;
            if (is_doubtful ? is_clear : without.has_value())
                result.row(v) = without->row(v);
            // If noise that was found is not plausible, thinned meshes have to prove it.
            left_to_do[v] = is_doubtful || without ? Correlation::None : Correlation::Possible;
        });
    }
    remove_on_thinned(before, left_to_do, Correlation::Found, result, exec);
    remove_on_thinned(before, left_to_do, Correlation::Possible, result, exec);
    return result == before ? std::nullopt : std::optional(result);
}

void MeshDenoiser::remove_on_thinned(const Points& before, std::span<const NoisyPlaces::Correlation> correlated,
                                     NoisyPlaces::Correlation which, Points& result, const Executor& exec) const
{
    if (std::ranges::find(correlated, which) == correlated.end())
        return;
    const bool needs_proof = which == NoisyPlaces::Correlation::Possible && n_thinned_ == 0;
    const float least_evidence = needs_proof ? proof_by_thinned : 0.0F;
    std::vector<int> n_chosen(correlated.size(), 0);
    std::vector<int> n_moved(correlated.size(), 0);
    Points sums = Points::Zero(before.rows(), 3);
    for (int round = 0; round < rounds_of_thinning; ++round) {
        const ThinnedMesh thinned =
            thin_out(*mesh_, *topology_, averages_.neighbours(), before, n_chosen, static_cast<std::uint64_t>(round));
        MeshDenoiser denoiser(thinned.mesh, thinned.topology, exec, {}, as_one_, n_thinned_ + 1, least_evidence);
        const Points moved = denoiser.denoise(thinned.mesh.vertices, {}, exec);
        // If the first thinned mesh has no noise, the others are not tried.
        if (round == 0 && denoiser.noise().part == 0.0)
            return;
        for (Index i = 0; i < thinned.mesh.n_vertices(); ++i) {
            const Index v = thinned.vertices[i];
            ++n_chosen[v];
            if (correlated[v] != which || !thinned.topology.moves(i))
                continue;
            ++n_moved[v];
            sums.row(v) += moved.row(i) - before.row(v);
        }
    }
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        if (n_moved[v] > 0)
            result.row(v) += sums.row(v) / static_cast<double>(n_moved[v]);
    });
}

void MeshDenoiser::fit(const Points& normals, double chord, Points& positions, const Executor& exec) const
{
    fit_vertices(*mesh_, *topology_, {}, {normals, std::min(most_relaxation, chord)}, positions, exec);
}

void MeshDenoiser::improve_fit(const Points& before, Findings& found, const Executor& exec) const
{
    const Points& normals = found.normals.normals;
    const auto chord = [&] { return mean_chord(*mesh_, found.fitted, normals, exec); };
    if (take_flatter_normals({*mesh_, *topology_, averages_, signs_, before, found.places.shares}, found.normals,
                             exec)) {
        found.fitted = before;
        fit(normals, chord(), found.fitted, exec);
    }
    for (int n = 0; n < most_further_fits; ++n) {
        const double now = chord();
        if (now <= near_enough)
            return;
        fit(normals, now, found.fitted, exec);
    }
}

KeptStructure MeshDenoiser::put_back_structure(const Points& before, Points& begun, Findings& found,
                                               const Executor& exec) const
{
    std::vector<double>& shares = found.places.shares;
    Points after(before.rows(), 3);
    for_each(exec, mesh_->n_vertices(),
             [&](Index v) { after.row(v) = begun.row(v) + shares[v] * (found.fitted.row(v) - begun.row(v)); });
    KeptStructure kept;
    if (after == before)
        return kept;
    std::vector<std::uint8_t> is_kept(shares.size(), 0);
    for (const auto& [component, place] :
         places_.find_structure({*mesh_, *topology_, averages_, before, after, found.normals, found.is_flat}, exec)) {
        kept.place = before.row(place);
        for (const Index f : places_.components().nodes[component])
            for (const Index v : mesh_->face(f))
                is_kept[v] = 1;
    }
    for (Index v = 0; v < mesh_->n_vertices(); ++v) {
        if (is_kept[v] == 0)
            continue;
        if (after.row(v) != before.row(v))
            ++kept.vertices;
        kept.height = std::max(kept.height, (after.row(v) - before.row(v)).norm());
        begun.row(v) = before.row(v);
        shares[v] = 0.0;
    }
    return kept;
}

void MeshDenoiser::keep_all_facing(const Points& before, Points wanted, Points& positions, const Executor& exec) const
{
    for_each(exec, static_cast<Index>(signs_.size()), [&](Index f) { wanted.row(f) *= signs_[f]; });
    keep_facing(signs_.empty() ? *mesh_ : oriented_, *topology_, before, wanted, positions, exec);
}

void MeshDenoiser::measure_noise(const Points& motions, std::span<const double> shares,
                                 std::span<const std::uint8_t> is_flat, const Points& normals, const Points& after,
                                 const Executor& exec)
{
    // The sums of squared motions and of squared edges; the numbers of vertices with noise, and of all vertices of
    // faces.
    using Sums = Eigen::Array4d;
    const Sums sums = sum(
        exec, mesh_->n_vertices(),
        [&](Index v) -> Sums {
            if (topology_->corners_at(v).empty())
                return Sums::Zero();
            if (shares[v] <= 0.0 || is_flat[v] != 0)
                return Sums(0.0, 0.0, 0.0, 1.0);
            const double motion = motion_along_normal(*topology_, normals, v, motions.row(v));
            return Sums(motion * motion, mean_squared_edge(*polygons_, *polygon_topology_, v, after), 1.0, 1.0);
        },
        Sums(Sums::Zero()));
    noise_ = sums[2] > 0.0 ? SurfaceNoise{noise_by_motion * std::sqrt(sums[0] / sums[2]),
                                          std::sqrt(sums[1] / sums[2]),
                                          sums[2] / sums[3],
                                          0.0,
                                          {}}
                           : SurfaceNoise{};
}

SurfaceNoise measure_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const auto measured = [&](const PolygonMesh& surface, const Topology& of_surface, bool as_one) {
        MeshDenoiser denoiser(surface, of_surface, exec, {}, as_one);
        denoiser.denoise(surface.vertices, {}, exec);
        return denoiser.noise();
    };
    const FilterSample sample = take_filter_sample(mesh, topology, exec);
    if (static_cast<Index>(sample.vertices.size()) == mesh.n_vertices())
        return measured(mesh, topology, false);
    const PolygonMesh patches = cut_out(mesh, topology, mesh.vertices, faces_of(sample, mesh, exec), exec).mesh;
    return measured(patches, make_topology(patches, exec), true);
}

}  // namespace seamflow
