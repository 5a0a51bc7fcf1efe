#include "solvers/denoising/smoother_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/filter_sample.h"
#include "solvers/denoising/mesh_piece.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/normals/smoothed_between_edges.h"

namespace seamflow {

namespace {

// The following numbers were measured on machine parts, round bodies and natural shapes whose true shape is known, with
// noise of 0.03 to 0.4 along the normals.

/// The amounts of smoothing between edges, in squared mean edge lengths.
constexpr std::array<double, 2> edge_keeping_amounts{8.0, 32.0};

/// The smoothing that is tried on surfaces of one size.
struct Trial {
    /// The amounts, ascending. A larger one is tried only in components in which the smaller one replaced some place,
    /// and used only at places that it makes smoother still.
    std::span<const double> amounts;
    /// The mean squared motion around a place, in squares of edge lengths, up to which the place may be replaced.
    float replaced_up_to;
};
constexpr Trial of_small_surfaces{edge_keeping_amounts, 0.15F * 0.15F};
/// A large surface has wide bends; and with more noise, smoothing takes too long for the little that is gained.
constexpr Trial of_large_surfaces{std::span(edge_keeping_amounts).last(1), 0.08F * 0.08F};
/// A place may not be replaced if the mean squared motion is more than this multiple of replaced_up_to; between that
/// limit and this multiple of it, results are blended.
constexpr float replaced_below = 1.7F;
/// The largest mean motion around a place, over the mean motion of the denoised surface. That surface keeps some noise,
/// relatively more where there is less noise: below little_motion, in edge lengths, the factor is larger.
constexpr float little_motion = 0.08F;
constexpr float most_motion_where_little = 1.2F;
constexpr float most_motion = 1.15F;
/// The limit of squared chords of normals: a sharper edge counts as no rougher.
constexpr float largest_squared_chord = 0.2F;
/// Surfaces with more faces are first tried on a sample, of which at least this fraction must become smoother.
constexpr Index most_untried_faces = 100'000;
constexpr double least_smoother_part = 0.05;
/// The rounds over which motions and roughness are averaged, and over which results are blended.
constexpr int averaging_rounds = 20;
constexpr int blending_rounds = 4;

using FaceRows = VertexAverages::Rows;

/// Measures surfaces with the vertices of a DenoisedSurface, and blends them.
class SmootherPlaces {
  public:
    SmootherPlaces(const DenoisedSurface& surface, const Executor& exec)
        : surface_(surface)
        , exec_(exec)
        , with_twins_(make_topology(surface.mesh, exec))
        , faces_(surface.mesh, with_twins_, exec)
        , vertices_(surface.mesh, surface.topology, exec)
        , edges_(edge_lengths_at_vertices(surface.mesh, surface.topology, surface.before, exec))
    {
        faces_.measure(surface.before, exec_);
    }

    /// #F by 2: squared motions along the normals, in squares of edge lengths, and roughness, both averaged around each
    /// face.
    [[nodiscard]] FaceRows measured(const Points& positions) const
    {
        const PolygonMesh& mesh = surface_.mesh;
        FaceVectors normals;
        faces_.measure_normals(positions, normals, exec_);
        const std::vector<float> roughness = faces_.roughness(normals, largest_squared_chord, exec_);
        FaceRows near(mesh.n_faces(), 2);
        for_each(exec_, mesh.n_faces(), [&](Index f) {
            double squares = 0.0;
            for (const Index v : mesh.face(f)) {
                const double motion = motion_along_normal(surface_.topology, surface_.normals, v,
                                                          positions.row(v) - surface_.before.row(v));
                if (edges_[v] > 0.0)
                    squares += std::pow(motion / edges_[v], 2);
            }
            near(f, 0) = static_cast<float>(squares / static_cast<double>(mesh.face(f).size()));
            near(f, 1) = roughness[f];
        });
        FaceRows around(mesh.n_faces(), 2);
        vertices_.spread(near, around, 0, averaging_rounds, exec_);
        return around;
    }

    /// The surface smoothed between edges, with its motions along the normals alone, times the shares.
    [[nodiscard]] Points along_normals(const Points& smoothed) const
    {
        Points there = surface_.before;
        for_each(exec_, surface_.mesh.n_vertices(),
                 [&](Index v) { there.row(v) += surface_.shares[v] * (smoothed.row(v) - surface_.before.row(v)); });
        return seamflow::along_normals(surface_.mesh, surface_.topology, surface_.before, there, surface_.normals,
                                       exec_);
    }

    /// #V: the fraction of another result that each vertex takes. @param of_faces #F by 1: 1 for faces that take the
    /// other result, 0 for others.
    [[nodiscard]] std::vector<double> blended(FaceRows of_faces) const
    {
        FaceRows around(of_faces.rows(), 1);
        vertices_.spread(of_faces, around, 0, blending_rounds, exec_);
        std::vector<double> weights(edges_.size(), 0.0);
        for_each(exec_, surface_.mesh.n_vertices(), [&](Index v) {
            const auto corners = surface_.topology.corners_at(v);
            if (surface_.topology.kind[v] != VertexKind::Interior)
                return;
            for (const Index corner : corners)
                weights[v] += static_cast<double>(around(surface_.topology.face_of[corner], 0)) /
                              static_cast<double>(corners.size());
        });
        return weights;
    }

  private:
    const DenoisedSurface& surface_;
    const Executor& exec_;
    Topology with_twins_;
    FaceAverages faces_;
    VertexAverages vertices_;
    /// #V: the mean length of the edges at each vertex.
    std::vector<double> edges_;
};

/// The mean squared motion up to which a place may be replaced.
/// @param of_first the mean squared motion of the denoised surface.
float most_squared_motion(float of_first)
{
    const float ratio = of_first < little_motion * little_motion ? most_motion_where_little : most_motion;
    return of_first * (ratio * ratio);
}

/// The mean length of the edges of some faces, counted in each face.
double mean_edge_of(const DenoisedSurface& surface, std::span<const Index> faces)
{
    double total = 0.0;
    double n = 0.0;
    for (const Index f : faces) {
        Index v = surface.mesh.face(f).back();
        for (const Index w : surface.mesh.face(f)) {
            total += (surface.before.row(w) - surface.before.row(std::exchange(v, w))).norm();
            n += 1.0;
        }
    }
    return total / n;
}

/// The fraction of a place that is replaced: falls smoothly from 1 to 0.
float replaced_fraction(const Trial& trial, float squared_motion)
{
    return std::clamp((replaced_below - squared_motion / trial.replaced_up_to) / (replaced_below - 1.0F), 0.0F, 1.0F);
}

/// Replaces places as take_smoother_places does, without trying a sample first.
void replace_places(const DenoisedSurface& surface, const Components& components, const Trial& trial, double angle,
                    Points& result, const Executor& exec)
{
    const Index n_faces = surface.mesh.n_faces();
    const SmootherPlaces places(surface, exec);
    const FaceRows of_first = places.measured(result);
    // The components in which some place may be replaced; after the first amount, the components in which some place
    // was replaced.
    std::vector<std::uint8_t> is_open(usize(components.count()));
    const auto open = [&](auto&& is_open_at) {
        std::ranges::fill(is_open, std::uint8_t{0});
        for (Index f = 0; f < n_faces; ++f)
            if (is_open_at(f))
                is_open[components.component_of[f]] = 1;
        return std::ranges::find(is_open, 1) != is_open.end();
    };
    const auto moves = [&](Index f) {
        return std::ranges::any_of(surface.mesh.face(f), [&](Index v) { return surface.shares[v] > 0.0; });
    };
    bool any = open([&](Index f) { return replaced_fraction(trial, of_first(f, 0)) > 0.0F && moves(f); });
    FaceRows of_result = of_first;
    for (std::size_t i = 0; any && i < trial.amounts.size(); ++i) {
        Points smoothed = surface.before;
        for (Index c = 0; c < components.count(); ++c) {
            if (is_open[c] == 0)
                continue;
            std::vector<Index> faces(components.nodes[c].begin(), components.nodes[c].end());
            std::ranges::sort(faces);
            const double mean_edge = mean_edge_of(surface, faces);
            for_each_piece(surface.mesh, surface.topology, surface.before, std::move(faces), {}, exec,
                           [&](const MeshPiece& piece, std::span<const std::uint8_t> is_own) {
                               NormalDiffusion diffusion(piece.mesh, piece.topology, exec);
                               const Points there = smoothed_between_edges(
                                   piece.mesh, piece.topology, {}, diffusion, piece.mesh.vertices,
                                   trial.amounts[i] * mean_edge * mean_edge, angle, exec);
                               for (Index f = 0; f < piece.mesh.n_faces(); ++f)
                                   if (is_own[f] != 0)
                                       for (const Index v : piece.mesh.face(f))
                                           smoothed.row(piece.vertices[v]) = there.row(v);
                           });
        }
        smoothed = places.along_normals(smoothed);
        const FaceRows of_smoothed = places.measured(smoothed);
        FaceRows better(n_faces, 1);
        for_each(exec, n_faces, [&](Index f) {
            const bool is_better = is_open[components.component_of[f]] != 0 &&
                                   of_smoothed(f, 0) <= most_squared_motion(of_first(f, 0)) &&
                                   of_smoothed(f, 1) < of_result(f, 1);
            better(f, 0) = is_better ? replaced_fraction(trial, of_first(f, 0)) : 0.0F;
        });
        any = open([&](Index f) { return better(f, 0) > 0.0F; });
        const std::vector<double> weights = places.blended(std::move(better));
        for_each(exec, surface.mesh.n_vertices(),
                 [&](Index v) { result.row(v) += weights[v] * (smoothed.row(v) - result.row(v)); });
        if (any && i + 1 < trial.amounts.size())
            of_result = places.measured(result);
    }
}

/// Whether replace_places replaces enough of a sample of patches spread all over the surface (see take_filter_sample).
bool helps_on_sample(const DenoisedSurface& surface, const Trial& trial, double angle, const Points& result,
                     const Executor& exec)
{
    const FilterSample sample = take_filter_sample(surface.mesh, surface.topology, exec);
    const MeshPiece piece =
        cut_out(surface.mesh, surface.topology, surface.before, faces_of(sample, surface.mesh, exec), exec);
    std::vector<double> shares;
    for (const Index v : piece.vertices)
        shares.push_back(surface.shares[v]);
    const Points normals = surface.normals(piece.faces, Eigen::all);
    const Points first = result(piece.vertices, Eigen::all);
    Points replaced = first;
    replace_places({piece.mesh, piece.topology, piece.mesh.vertices, normals, shares},
                   face_components(piece.mesh, piece.topology), trial, angle, replaced, exec);
    const auto n = std::ranges::count_if(sample.measured, [&](Index i) {
        const Index v = place_in(piece.vertices, sample.vertices[i]);
        return replaced.row(v) != first.row(v);
    });
    return static_cast<double>(n) >= least_smoother_part * static_cast<double>(sample.measured.size());
}

}  // namespace

void take_smoother_places(const DenoisedSurface& surface, const Components& components, double angle, Points& result,
                          const Executor& exec)
{
    if (std::ranges::none_of(surface.shares, [](double share) { return share > 0.0; }))
        return;
    const bool is_large = surface.mesh.n_faces() > most_untried_faces;
    const Trial& trial = is_large ? of_large_surfaces : of_small_surfaces;
    if (!is_large || helps_on_sample(surface, trial, angle, result, exec))
        replace_places(surface, components, trial, angle, result, exec);
}

}  // namespace seamflow
