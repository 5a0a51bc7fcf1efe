#include "partition/metrics/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <xxhash.h>

namespace seamflow {

namespace {

/// The hash of a half-edge; that of the opposite half-edge is the negative.
XXH64_hash_t hash_of_half_edge(Index from, Index to)
{
    const std::array ends{std::min(from, to), std::max(from, to)};
    const XXH64_hash_t hash = XXH3_64bits(ends.data(), sizeof ends);
    return from < to ? hash : XXH64_hash_t{0} - hash;
}

/// The sum of the hashes of the half-edges of a face.
XXH64_hash_t hash_of_face(std::span<const Index> corners)
{
    XXH64_hash_t of_face = 0;
    Index from = corners.back();
    for (const Index to : corners) {
        of_face += hash_of_half_edge(from, to);
        from = to;
    }
    return of_face;
}

}  // namespace

/// Half-edges and their opposites cancel each other: then the sum of all hashes is 0, and hardly ever otherwise.
bool encloses_volume(const PolygonMesh& mesh, const Executor& exec)
{
    const auto hash_of = [&](Index f) { return hash_of_face(mesh.face(f)); };
    return mesh.n_faces() > 0 && sum(exec, mesh.n_faces(), hash_of, XXH64_hash_t{0}) == 0;
}

bool encloses_volume(const PolygonMesh& mesh, std::span<const Index> faces, const Executor& exec)
{
    const auto hash_of = [&](Index i) { return hash_of_face(mesh.face(faces[usize(i)])); };
    return !faces.empty() && sum(exec, static_cast<Index>(faces.size()), hash_of, XXH64_hash_t{0}) == 0;
}

double volume_of_cones(const PolygonMesh& mesh, const Points& positions, const Point& origin, const Executor& exec)
{
    return sum(exec, mesh.n_faces(), [&](Index f) { return cone_volume(mesh.face(f), positions, origin); });
}

}  // namespace seamflow
