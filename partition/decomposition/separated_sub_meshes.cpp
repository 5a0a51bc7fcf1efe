#include "partition/decomposition/separated_sub_meshes.h"

#include <cstdint>
#include <numeric>

namespace seamflow {

namespace {

/// Numbers the copies of a sub-mesh's vertices. A vertex whose own number the copy in an earlier sub-mesh has gets a
/// new number, and is appended to `originals`.
/// @param taken one entry per vertex of the whole mesh: 1 if a copy has its number; updated.
/// @param originals for each number, the vertex of the whole mesh.
std::vector<Index> number_vertices(const SubMesh& sub_mesh, std::vector<std::uint8_t>& taken,
                                   std::vector<Index>& originals)
{
    std::vector<Index> vertex_of;
    vertex_of.reserve(sub_mesh.n_vertices);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v) {
        const Index global = sub_mesh.local_to_global[v];
        if (taken[global] == 0) {
            taken[global] = 1;
            vertex_of.push_back(global);
        } else {
            vertex_of.push_back(static_cast<Index>(originals.size()));
            originals.push_back(global);
        }
    }
    return vertex_of;
}

}  // namespace

SeparatedSubMeshes separate(const PolygonMesh& mesh, const Decomposition& decomposition)
{
    SeparatedSubMeshes separated;
    separated.mesh.face_offsets = mesh.face_offsets;
    separated.mesh.face_vertices = mesh.face_vertices;
    std::vector<Index> originals(mesh.n_vertices());
    std::iota(originals.begin(), originals.end(), 0);
    std::vector<std::uint8_t> taken(mesh.n_vertices(), 0);
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const auto& vertex_of = separated.vertex_of.emplace_back(number_vertices(sub_mesh, taken, originals));
        for (std::size_t f = 0; f < sub_mesh.faces.size(); ++f) {
            const auto corners = sub_mesh.face_vertices[static_cast<Index>(f)];
            for (std::size_t k = 0; k < corners.size(); ++k)
                separated.mesh.face_vertices[mesh.face_offsets[sub_mesh.faces[f]] + k] = vertex_of[corners[k]];
        }
    }
    separated.mesh.vertices = mesh.vertices(originals, Eigen::all);
    return separated;
}

}  // namespace seamflow
