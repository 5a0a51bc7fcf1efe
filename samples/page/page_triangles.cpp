#include "samples/page/page_triangles.h"

#include <algorithm>

#include "partition/metrics/triangulation.h"

namespace seamflow {

namespace {

/// The half-edge of face f between two of its vertices, whichever way it runs; -1 if they are not adjacent there.
Index half_edge_between(const PolygonMesh& mesh, Index f, Index a, Index b)
{
    const auto face = mesh.face(f);
    const std::size_t n = face.size();
    const auto from = static_cast<std::size_t>(std::find(face.begin(), face.end(), a) - face.begin());
    if (face[(from + 1) % n] == b)
        return mesh.face_offsets[f] + static_cast<Index>(from);
    const std::size_t before = (from + n - 1) % n;
    return face[before] == b ? mesh.face_offsets[f] + static_cast<Index>(before) : -1;
}

std::uint8_t edge_bits(const PolygonMesh& mesh, const Topology& topology, Index f, const Triangle& triangle)
{
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index h = half_edge_between(mesh, f, triangle[k], triangle[(k + 1) % 3]);
        if (h >= 0 && (topology.twin[h] < 0 || h < topology.twin[h]))
            bits = static_cast<std::uint8_t>(bits | 1U << k);
    }
    return bits;
}

}  // namespace

PageTriangles page_triangles(const PolygonMesh& mesh, const Topology& topology)
{
    PageTriangles result;
    result.corners.reserve(std::size_t{3} * (mesh.n_corners() - 2 * mesh.n_faces()));
    result.edges.reserve(result.corners.capacity() / 3);
    std::vector<Triangle> triangles;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        triangles.clear();
        triangulate(mesh.face(f), mesh.vertices, triangles);
        for (const Triangle& triangle : triangles) {
            for (const Index v : triangle)
                result.corners.push_back(static_cast<std::uint32_t>(v));
            result.edges.push_back(edge_bits(mesh, topology, f, triangle));
        }
        result.per_face.push_back(static_cast<std::uint32_t>(triangles.size()));
    }
    return result;
}

}  // namespace seamflow
