#include "solvers/denoising/mesh_piece.h"

#include <utility>

#include "partition/cut/boxes.h"
#include "partition/decomposition/index_set.h"

namespace seamflow {

MeshPiece cut_out(const PolygonMesh& mesh, const Topology& topology, const Points& positions, std::vector<Index> faces,
                  const Executor& exec)
{
    MeshPiece piece;
    for (const Index f : faces)
        piece.mesh.add_face(mesh.face(f));
    const IndexSet vertices(piece.mesh.face_vertices);
    for_each(exec, piece.mesh.n_corners(), [&](Index corner) {
        Index& v = piece.mesh.face_vertices[corner];
        v = vertices[v];
    });
    piece.faces = std::move(faces);
    piece.vertices = vertices.ascending();
    piece.mesh.vertices = positions(piece.vertices, Eigen::all);
    piece.topology = make_topology(piece.mesh, exec);
    for_each(exec, piece.mesh.n_vertices(), [&](Index i) {
        piece.topology.kind[i] = topology.kind[piece.vertices[i]];
        piece.topology.fixed[i] = topology.fixed[piece.vertices[i]];
    });
    return piece;
}

std::vector<Index> boxes_of_faces(const PolygonMesh& mesh, const Points& positions, Index n_boxes, const Executor& exec)
{
    const IndexLists boxes = divide_into_boxes(positions, n_boxes, exec);
    std::vector<Index> of_vertices(usize(mesh.n_vertices()));
    for_each(exec, n_boxes, [&](Index box) {
        for (const Index v : boxes[box])
            of_vertices[v] = box;
    });
    std::vector<Index> of_faces(usize(mesh.n_faces()));
    for_each(exec, mesh.n_faces(), [&](Index f) { of_faces[f] = of_vertices[mesh.face(f).front()]; });
    return of_faces;
}

}  // namespace seamflow
