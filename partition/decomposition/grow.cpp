#include "partition/decomposition/grow.h"

#include <algorithm>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The faces around `front` that are not in `faces` and into which part s may grow.
std::vector<Index> next_layer(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                              std::span<const Index> front, std::span<const Index> faces)
{
    std::vector<Index> layer;
    for (const Index of_front : front)
        for (const Index v : mesh.face(of_front))
            for (const Index corner : topology.corners_at(v)) {
                const Index f = topology.face_of[corner];
                const Index part = overlap.labels[f];
                if (part != s && overlap.stage[part] >= overlap.stage[s] && find_in(faces, f) < 0)
                    layer.push_back(f);
            }
    sort_unique(layer);
    return layer;
}

}  // namespace

std::vector<Index> grow(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                        std::vector<Index> faces)
{
    std::vector<Index> front = faces;
    for (int layer = 0; layer < overlap.layers && !front.empty(); ++layer) {
        front = next_layer(mesh, topology, overlap, s, front, faces);
        const auto middle = static_cast<std::ptrdiff_t>(faces.size());
        faces.insert(faces.end(), front.begin(), front.end());
        std::inplace_merge(faces.begin(), faces.begin() + middle, faces.end());
    }
    return faces;
}

}  // namespace seamflow
