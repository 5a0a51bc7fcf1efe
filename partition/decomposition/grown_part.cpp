#include "partition/decomposition/grown_part.h"

#include <utility>

#include "partition/decomposition/local_mesh.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// The vertices of these faces that may move, as in the whole mesh, ascending.
std::vector<Index> movable_vertices(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> faces)
{
    std::vector<Index> vertices;
    for (const Index f : faces)
        for (const Index v : mesh.face(f))
            if (topology.moves(v))
                vertices.push_back(v);
    sort_unique(vertices);
    return vertices;
}

}  // namespace

GrownPart make_grown_part(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, int reach, Index s,
                          std::vector<Index> faces)
{
    GrownPart part;
    std::vector<Index> grown = grow(mesh, topology, overlap, s, std::move(faces));
    part.unknowns = movable_vertices(mesh, topology, grown);
    const Overlap beyond{overlap.labels, overlap.rank, reach};
    SubMeshDraft draft = copy_faces(mesh, topology, grow(mesh, topology, beyond, s, std::move(grown)));
    part.sub_mesh = std::move(draft.sub_mesh);
    part.sub_mesh.owned.assign(part.sub_mesh.n_vertices, 0);
    std::vector<Index> labels;
    for (Index& v : part.unknowns) {
        labels_around(topology, overlap.labels, v, labels);
        v = draft.vertices[v];
        part.sub_mesh.owned[v] = labels.front() == s ? 1 : 0;
    }
    return part;
}

}  // namespace seamflow
