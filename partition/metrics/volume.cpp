#include "partition/metrics/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <xxhash.h>

namespace seamflow {

namespace {

/// That of the opposite half-edge is the negative.
XXH64_hash_t hash_of_half_edge(Index from, Index to)
{
    const std::array ends{std::min(from, to), std::max(from, to)};
    const XXH64_hash_t hash = XXH3_64bits(ends.data(), sizeof ends);
    return from < to ? hash : XXH64_hash_t{0} - hash;
}

}  // namespace

/// Half-edges and their opposites cancel each other: the sum of their hashes is 0 then, and hardly ever else.
bool encloses_volume(const PolygonMesh& mesh, const Loop& loop)
{
    std::vector<XXH64_hash_t> of_block(at(mesh.n_faces() / block_size) + 1, 0);
    for_each_block(loop, mesh.n_faces(), [&](Index block, Index begin, Index end) {
        XXH64_hash_t sum = 0;
        for (Index f = begin; f < end; ++f) {
            const std::span<const Index> corners = mesh.face(f);
            Index from = corners.back();
            for (const Index to : corners) {
                sum += hash_of_half_edge(from, to);
                from = to;
            }
        }
        of_block[block] = sum;
    });
    XXH64_hash_t sum = 0;
    for (const XXH64_hash_t part : of_block)
        sum += part;
    return mesh.n_faces() > 0 && sum == 0;
}

double volume_of_cones(const PolygonMesh& mesh, const Points& positions, const Point& origin, const Loop& loop)
{
    return sum(loop, mesh.n_faces(), [&](Index f) {
        const std::span<const Index> corners = mesh.face(f);
        Point mean = Point::Zero();
        for (const Index v : corners)
            mean += positions.row(v) - origin;
        return vector_area(corners, positions).dot(mean) / (3.0 * static_cast<double>(corners.size()));
    });
}

}  // namespace seamflow
