#include "solvers/normals/normal_diffusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The number of rounds, each with weights computed from the last normals (measured, like the constants below: see
/// engine/accuracy.md).
constexpr int diffusion_rounds = 4;
/// Chords longer than this many σ stop diffusion.
constexpr double sigmas_at_edges = 3.0;
/// σ, and the width over which guides are averaged, as multiples of the noise, which is a chord.
constexpr double sigma_by_noise = 8.0;
constexpr double width_by_noise = 7.0;
/// Above this noise, means of whole patches are better guides than means of similar normals, if the patch disagrees by
/// no more than this many times the square of the noise.
constexpr double much_noise = 0.03;
constexpr double most_disagreement = 8.0;
/// The mean around another face is taken as a guide only if its normals disagree less by this factor.
constexpr double clearly_less = 0.5;
/// The least σ: shorter chords are rounding errors.
constexpr double least_sigma = 1e-6;
/// The width of the widest plane that noise of whole numbers leaves, twice its area over its perimeter, in lengths of
/// its edges: a terrace is long, but narrow.
constexpr double widest_plane_of_noise = 1.5;
/// A plane is part of a round shape if the chord to the mean of the planes around it is less than this fraction of the
/// chord to each.
constexpr double even_bend = 0.2;
/// The residual after a round relative to that at its beginning; and the most iterations.
constexpr double diffusion_tolerance = 1e-2;
constexpr int most_diffusion_iterations = 500;
/// The height of a face over its longest side, relative to its coordinates, below which its normal is a rounding error
/// of a file in single precision.
constexpr double least_height = 4.0 * std::numeric_limits<float>::epsilon();
/// The weights relative to the diagonal of A above which a face gets the mean of its neighbours to all digits.
constexpr double largest_diffusion_weight = 1e20;

double sum_of_products(const Points& a, const Points& b, const Executor& exec)
{
    return sum(exec, static_cast<Index>(a.rows()), [&](Index i) { return a.row(i).dot(b.row(i)); });
}

/// The median of the values below a limit; 0 if there are none.
double median_below(double limit, std::vector<double> values)
{
    std::erase_if(values, [&](double value) { return !(value < limit); });
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The area of a face; 0 if its normal cannot be determined: such a face gets no normal, and vertices ignore it.
double area_with_normal(std::span<const Index> corners, const Points& positions)
{
    double farthest = 0.0;
    double longest = 0.0;
    const Point origin = positions.row(corners.front());
    for (const Index v : corners) {
        farthest = std::max(farthest, positions.row(v).cwiseAbs().maxCoeff());
        longest = std::max(longest, (positions.row(v) - origin).norm());
    }
    const double size = area(corners, positions);
    return size > least_height * farthest * longest ? size : 0.0;
}

}  // namespace

NormalDiffusion::NormalDiffusion(const PolygonMesh& mesh, const PolygonMesh& connected, const Topology& topology,
                                 const Executor& exec)
    : mesh_(&mesh)
    , neighbours_(make_face_neighbours(connected, topology, exec))
    , signs_(face_signs(connected, topology))
    , across_(mesh.face_vertices.size())
    , areas_(usize(mesh.n_faces()))
    , centroids_(mesh.n_faces(), 3)
    , reach_(areas_.size())
    , scale_(areas_.size())
    , guides_(mesh.n_faces(), 3)
    , means_(mesh.n_faces(), 3)
    , disagreement_(areas_.size())
    , weights_(neighbours_.faces.size())
    , diagonal_(areas_.size())
    , residual_(mesh.n_faces(), 3)
    , direction_(mesh.n_faces(), 3)
    , product_(mesh.n_faces(), 3)
{
    for_each(exec, static_cast<Index>(across_.size()),
             [&](Index h) { across_[h] = topology.twin[h] >= 0 ? topology.face_of[topology.twin[h]] : Index{-1}; });
}

Points NormalDiffusion::smoothed(const Points& positions, double time_step, double angle, const Executor& exec)
{
    const Index n = mesh_->n_faces();
    measure(positions, time_step / diffusion_rounds, exec);
    const double edge_chord = 2.0 * std::sin(angle * std::numbers::pi / 360.0);
    Points normals(n, 3);
    for_each(exec, n, [&](Index f) {
        normals.row(f) = areas_[f] > 0.0 ? Point(vector_area(mesh_->face(f), positions)) : Point(Point::Zero());
        normals.row(f) = unit_or_zero((signs_.empty() ? 1.0 : signs_[f]) * normals.row(f));
    });
    noise_ = measure_noise(positions, normals, edge_chord, exec);
    const double longest = std::min(sigmas_at_edges * std::max(sigma_by_noise * noise_, least_sigma), edge_chord);
    for (int round = 0; round < diffusion_rounds; ++round) {
        find_guides(normals, exec);
        if (noise_ > much_noise)
            find_patches(normals, exec);
        find_weights(normals, longest, exec);
        diffuse(normals, exec);
        for_each(exec, n, [&](Index f) { normals.row(f) = unit_or_zero(normals.row(f)); });
    }
    return normals;
}

/// Computes areas_, centroids_, reach_ and scale_. @param time_step τ, in length².
void NormalDiffusion::measure(const Points& positions, double time_step, const Executor& exec)
{
    const Index n = mesh_->n_faces();
    for_each(exec, n, [&](Index f) {
        areas_[f] = area_with_normal(mesh_->face(f), positions);
        centroids_.row(f) = centroid(mesh_->face(f), positions);
    });
    const double mean_area = sum(exec, n, [&](Index f) { return areas_[f]; }) / n;
    for_each(exec, n, [&](Index f) {
        areas_[f] = mean_area > 0.0 ? areas_[f] / mean_area : 0.0;
        double squares = 0.0;
        for (const Index g : neighbours_[f])
            squares += (centroids_.row(f) - centroids_.row(g)).squaredNorm();
        const std::size_t count = neighbours_[f].size();
        reach_[f] = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
    });
    for_each(exec, n, [&](Index f) {
        double moment = 0.0;
        for (const Index g : neighbours_[f]) {
            const double squared = (centroids_.row(f) - centroids_.row(g)).squaredNorm();
            if (const double reach = reach_[f] * reach_[g]; reach > 0.0)
                moment += std::exp(-2.0 * squared / reach) * squared;
        }
        scale_[f] = moment > 0.0 ? 2.0 * std::sqrt(areas_[f] * (time_step / moment)) : 0.0;
    });
}

/// The noise: the median over faces of the chord between the face and the most similar neighbour across an edge, or the
/// mean of its neighbours, which is more similar on round shapes. Neighbours across edges sharper than edge_chord do
/// not count. If most faces have a neighbour with the same normal, as where heights are whole numbers, narrow planes of
/// such faces are measured instead of faces.
double NormalDiffusion::measure_noise(const Points& positions, const Points& normals, double edge_chord,
                                      const Executor& exec) const
{
    const Index n = mesh_->n_faces();
    std::vector<double> chords(usize(n));
    for_each(exec, n, [&](Index f) {
        chords[f] = std::numeric_limits<double>::infinity();
        if (areas_[f] == 0.0)
            return;
        Point mean = Point::Zero();
        for (Index h = mesh_->face_offsets[f]; h < mesh_->face_offsets[f + 1]; ++h) {
            if (across_[h] < 0)
                continue;
            const double chord = (normals.row(f) - normals.row(across_[h])).norm();
            chords[f] = std::min(chords[f], chord);
            if (chord < edge_chord)
                mean += normals.row(across_[h]);
        }
        if (const double length = mean.norm(); length > 0.0)
            chords[f] = std::min(chords[f], (normals.row(f) - mean / length).norm());
    });
    const double noise = median_below(edge_chord, chords);
    if (noise > least_sigma)
        return noise;
    spread_over_planes(positions, normals, edge_chord, chords);
    return median_below(edge_chord, chords);
}

/// Gives all faces of a plane the same chord. A plane is a set of connected faces with the same normal; its chord is
/// the shorter one of two: between its normal and the most similar normal of a plane around it, and between its normal
/// and the mean of these normals, weighted by the lengths of edges. The chord is 0 for wide planes, and where the
/// planes around bend like a round shape, which noise does not make.
/// @param chords #F: replaced, except for faces without area.
void NormalDiffusion::spread_over_planes(const Points& positions, const Points& normals, double edge_chord,
                                         std::vector<double>& chords) const
{
    std::vector<std::uint8_t> is_known(chords.size());
    std::vector<Index> plane;
    for (Index first = 0; first < mesh_->n_faces(); ++first) {
        if (is_known[first] != 0 || areas_[first] == 0.0)
            continue;
        is_known[first] = 1;
        plane.assign(1, first);
        double least = std::numeric_limits<double>::infinity();
        Point mean = Point::Zero();
        double size = 0.0;
        double perimeter = 0.0;
        double edges = 0.0;
        double n_edges = 0.0;
        for (std::size_t i = 0; i < plane.size(); ++i) {
            const Index f = plane[i];
            const auto corners = mesh_->face(f);
            size += area(corners, positions);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Index g = across_[usize(mesh_->face_offsets[f]) + k];
                const Index next = corners[k + 1 < corners.size() ? k + 1 : 0];
                const double edge = (positions.row(next) - positions.row(corners[k])).norm();
                edges += edge;
                n_edges += 1.0;
                if (g < 0 || areas_[g] == 0.0) {
                    perimeter += edge;
                    continue;
                }
                const double chord = (normals.row(f) - normals.row(g)).norm();
                if (chord > least_sigma) {
                    perimeter += edge;
                    least = std::min(least, chord);
                    if (chord < edge_chord)
                        mean += edge * normals.row(g);
                } else if (is_known[g] == 0) {
                    is_known[g] = 1;
                    plane.push_back(g);
                }
            }
        }
        const double length = mean.norm();
        const double from_mean = length > 0.0 ? (normals.row(first) - mean / length).norm() : least;
        const bool is_wide = 2.0 * size * n_edges > widest_plane_of_noise * perimeter * edges;
        const bool is_shape = is_wide || from_mean < even_bend * least;
        for (const Index f : plane)
            chords[f] = is_shape ? 0.0 : std::min(least, from_mean);
    }
}

/// Finds the guides that are means of the similar normals around each face.
void NormalDiffusion::find_guides(const Points& normals, const Executor& exec)
{
    const double width = std::max(width_by_noise * noise_, least_sigma);
    for_each(exec, mesh_->n_faces(), [&](Index f) {
        Point total = areas_[f] * normals.row(f);
        for (const Index g : neighbours_[f]) {
            const double chord = (normals.row(f) - normals.row(g)).norm() / width;
            total += areas_[g] * std::exp(-0.5 * chord * chord) * normals.row(g);
        }
        guides_.row(f) = unit_or_zero(total);
    });
}

/// Replaces guides by the mean normals of whole patches, each a face and its neighbours: around the face itself or one
/// of its neighbours, if the normals of the patch agree, so that it is on one side of edges.
void NormalDiffusion::find_patches(const Points& normals, const Executor& exec)
{
    const Index n = mesh_->n_faces();
    for_each(exec, n, [&](Index f) {
        Point total = areas_[f] * normals.row(f);
        double weight = areas_[f];
        for (const Index g : neighbours_[f]) {
            total += areas_[g] * normals.row(g);
            weight += areas_[g];
        }
        disagreement_[f] = weight > 0.0 ? 1.0 - total.norm() / weight : 1.0;
        means_.row(f) = unit_or_zero(total);
    });
    for_each(exec, n, [&](Index f) {
        Index patch = f;
        double least = clearly_less * disagreement_[f];
        for (const Index g : neighbours_[f])
            if (disagreement_[g] < least) {
                least = disagreement_[g];
                patch = g;
            }
        if (disagreement_[patch] < most_disagreement * noise_ * noise_)
            guides_.row(f) = means_.row(patch);
    });
}

/// Computes weights_ and diagonal_. @param longest the chord of normals, 3σ or less, from which on nothing diffuses.
void NormalDiffusion::find_weights(const Points& normals, double longest, const Executor& exec)
{
    for_each(exec, mesh_->n_faces(), [&](Index f) {
        double total = 0.0;
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const Index g = neighbours_.faces[k];
            const double chords = std::sqrt((normals.row(f) - normals.row(g)).squaredNorm() *
                                            (guides_.row(f) - guides_.row(g)).squaredNorm());
            const double diffusivity = std::max(1.0 - chords / (longest * longest), 0.0);
            const double squared = (centroids_.row(f) - centroids_.row(g)).squaredNorm();
            const double scale = scale_[f] * scale_[g];
            const double weight =
                scale > 0.0 ? scale * std::exp(-2.0 * squared / (reach_[f] * reach_[g])) * diffusivity * diffusivity
                            : 0.0;
            weights_[k] = static_cast<float>(std::min(weight, largest_diffusion_weight));
            total += static_cast<double>(weights_[k]);
        }
        diagonal_[f] = areas_[f] + total;
    });
}

/// Conjugate gradients for A N + τ L N = A N₀ from N₀ on, preconditioned by the diagonal.
void NormalDiffusion::diffuse(Points& normals, const Executor& exec)
{
    const Index n = mesh_->n_faces();
    const auto laplacian = [&](const Points& x, Index f) {
        Point result = Point::Zero();
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k)
            result += static_cast<double>(weights_[k]) * (x.row(f) - x.row(neighbours_.faces[k]));
        return result;
    };
    const auto preconditioned = [&](Index f) {
        return diagonal_[f] > 0.0 ? Point(residual_.row(f) / diagonal_[f]) : Point(Point::Zero());
    };
    const auto energy = [&] { return sum(exec, n, [&](Index f) { return residual_.row(f).dot(preconditioned(f)); }); };
    // r = A N₀ - (A + τ L) N₀, p = z = D⁻¹ r
    for_each(exec, n, [&](Index f) {
        residual_.row(f) = -laplacian(normals, f);
        direction_.row(f) = preconditioned(f);
    });
    const double squared_goal = diffusion_tolerance * diffusion_tolerance * sum_of_products(residual_, residual_, exec);
    double before = energy();
    for (int i = 0; i < most_diffusion_iterations && sum_of_products(residual_, residual_, exec) > squared_goal; ++i) {
        // q = (A + τ L) p, α = (r, z) / (p, q)
        for_each(exec, n, [&](Index f) { product_.row(f) = areas_[f] * direction_.row(f) + laplacian(direction_, f); });
        const double alpha = before / sum_of_products(direction_, product_, exec);
        if (!std::isfinite(alpha))
            break;
        // N = N + α p, r = r - α q
        for_each(exec, n, [&](Index f) {
            normals.row(f) += alpha * direction_.row(f);
            residual_.row(f) -= alpha * product_.row(f);
        });
        // β = (r, z) / (r, z) before, p = z + β p
        const double after = energy();
        const double beta = after / before;
        before = after;
        for_each(exec, n, [&](Index f) { direction_.row(f) = preconditioned(f) + beta * direction_.row(f); });
    }
}

}  // namespace seamflow
