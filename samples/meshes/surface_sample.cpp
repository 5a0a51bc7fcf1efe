#include "samples/meshes/surface_sample.h"

#include <algorithm>

#include <xxhash.h>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The faces around so many vertices give the roughness of all within about a hundredth.
constexpr Index enough_vertices = 4000;

}  // namespace

bool is_sampled(Index v, Index n_vertices)
{
    return n_vertices <= enough_vertices ||
           XXH3_64bits(&v, sizeof v) % static_cast<XXH64_hash_t>(n_vertices) < enough_vertices;
}

PolygonMesh extract(const IndexLists& faces, const std::vector<Index>& vertices)
{
    PolygonMesh part;
    std::vector<Index> corners;
    for (Index f = 0; f < faces.size(); ++f) {
        corners.clear();
        for (const Index v : faces[f])
            corners.push_back(place_in(vertices, v));
        part.add_face(corners);
    }
    return part;
}

}  // namespace seamflow
