#include "samples/training/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "samples/training/draws.h"

namespace seamflow {

namespace {

enum class NoiseKind {
    AlongNormals,
    AllDirections,
    Coordinates,
    SomeAlongNormals,
    SomeInAllDirections,
    OneAxis,
    Correlated,
};

NoiseKind draw_kind(RandomNumbers& random)
{
    if (chance(random, 0.4))
        return NoiseKind::AlongNormals;
    // Twice as often at some vertices only.
    constexpr NoiseKind others[] = {NoiseKind::AllDirections,    NoiseKind::Coordinates,
                                    NoiseKind::SomeAlongNormals, NoiseKind::SomeInAllDirections,
                                    NoiseKind::SomeAlongNormals, NoiseKind::SomeInAllDirections,
                                    NoiseKind::OneAxis,          NoiseKind::Correlated};
    return others[random.below(8)];
}

/// In mean edge lengths.
double draw_deviation(NoiseRange range, RandomNumbers& random)
{
    if (range == NoiseRange::ForNoise)
        return scale_between(random, 0.015, 0.8);
    return chance(random, 0.06) ? 0.003 : 0.03 + 0.75 * std::pow(random.unit(), 1.3);
}

/// In any direction, with a length of variance 1.
Point any_motion(RandomNumbers& random)
{
    const Point direction = random_direction(random);
    return normal_number(random) * direction;
}

/// The motions of vertices, whose standard deviations are about 1. The noise of some vertices is larger.
Points draw_motions(const PolygonMesh& mesh, const Topology& topology, NoiseKind kind, RandomNumbers& random)
{
    const VertexNormals normals(mesh, topology);
    const Point axis = random_direction(random);
    const double part = between(random, 0.2, 0.7);
    Points motions = Points::Zero(mesh.n_vertices(), 3);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point normal = normals(v, mesh.vertices);
        switch (kind) {
        case NoiseKind::AlongNormals:
        case NoiseKind::Correlated:
            motions.row(v) = normal_number(random) * normal;
            break;
        case NoiseKind::AllDirections:
            motions.row(v) = any_motion(random);
            break;
        case NoiseKind::Coordinates:
            motions.row(v) = 0.7 * normal_vector(random);
            break;
        case NoiseKind::SomeAlongNormals:
            if (chance(random, part))
                motions.row(v) = 1.4 * normal_number(random) * normal;
            break;
        case NoiseKind::SomeInAllDirections:
            if (chance(random, part))
                motions.row(v) = 1.6 * any_motion(random);
            break;
        case NoiseKind::OneAxis:
            motions.row(v) = 1.2 * normal_number(random) * axis;
            break;
        }
    }
    return motions;
}

/// Makes motions alike at neighbours; they stay as large on average, up to a limit.
void correlate(Points& motions, const PolygonMesh& mesh, const Topology& topology, double most, RandomNumbers& random)
{
    constexpr double weight = 0.5;
    const double before = motions.norm();
    for (int rounds = whole_between(random, 1, 2); rounds > 0; --rounds) {
        const Points last = motions;
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const std::vector<Index> neighbours = neighbours_of(mesh, topology, v);
            for (const Index w : neighbours)
                motions.row(v) += weight * last.row(w);
            motions.row(v) /= 1.0 + weight * static_cast<double>(neighbours.size());
        }
    }
    const double wanted = std::min(before, most * std::sqrt(static_cast<double>(mesh.n_vertices())));
    if (const double now = motions.norm(); now > 0.0)
        motions *= wanted / now;
}

/// Takes the noise away on one side, at once or little by little.
void limit_to_one_side(Points& motions, const Points& positions, RandomNumbers& random)
{
    Eigen::ArrayXd heights = positions * random_direction(random).transpose();
    heights = (heights - heights.minCoeff()) / (heights.maxCoeff() - heights.minCoeff());
    const double begin = between(random, 0.1, 0.7);
    const double slope = chance(random, 0.4) ? 100.0 : between(random, 2.0, 6.0);
    motions.array().colwise() *= (slope * (heights - begin)).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace

Points add_noise(const PolygonMesh& mesh, const Topology& topology, NoiseRange range, RandomNumbers& random)
{
    constexpr double most_correlated = 0.35;
    const double edge = mean_edge_length(mesh);
    NoiseKind kind = draw_kind(random);
    if (range == NoiseRange::ForNoise && kind == NoiseKind::Correlated)
        kind = NoiseKind::AlongNormals;
    const double deviation = draw_deviation(range, random);
    Points motions = edge * deviation * draw_motions(mesh, topology, kind, random);
    if (chance(random, 0.12))
        limit_to_one_side(motions, mesh.vertices, random);
    if (kind == NoiseKind::Correlated)
        correlate(motions, mesh, topology, most_correlated * edge, random);
    Points noisy = mesh.vertices + motions;
    if (chance(random, 0.05)) {
        const int axis = random.below(3);
        const double step = edge * between(random, 0.2, 0.8);
        noisy.col(axis) = step * (noisy.col(axis) / step).array().round();
    }
    return noisy;
}

}  // namespace seamflow
