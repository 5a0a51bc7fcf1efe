#include "solvers/denoising/mesh_piece.h"

#include <bit>
#include <utility>

#include "partition/cut/boxes.h"
#include "partition/decomposition/grow.h"
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
    if (!topology.junctions.empty())
        free_junctions(piece.mesh, piece.topology, exec);
    for_each(exec, piece.mesh.n_vertices(), [&](Index i) {
        piece.topology.kind[i] = topology.kind[piece.vertices[i]];
        piece.topology.fixed[i] = topology.fixed[piece.vertices[i]];
    });
    return piece;
}

void for_each_piece(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                    std::vector<Index> faces, const PieceSizes& sizes, const Executor& exec,
                    const std::function<void(const MeshPiece&, std::span<const std::uint8_t> is_own)>& action)
{
    std::vector<std::uint8_t> is_own(faces.size(), 1);
    if (std::ssize(faces) <= sizes.most_faces) {
        action(cut_out(mesh, topology, positions, std::move(faces), exec), is_own);
        return;
    }
    // A power of two, as divide_into_boxes requires.
    const auto n_boxes = static_cast<Index>(std::bit_ceil(usize((mesh.n_faces() - 1) / sizes.most_faces + 1)));
    const IndexLists boxes = divide_into_boxes(positions, n_boxes, exec);
    std::vector<Index> box_of(usize(mesh.n_vertices()));
    for_each(exec, n_boxes, [&](Index box) {
        for (const Index v : boxes[box])
            box_of[v] = box;
    });
    std::vector<Index> piece_of(usize(mesh.n_faces()), n_boxes);
    for (const Index f : faces)
        piece_of[f] = box_of[mesh.face(f).front()];
    const IndexLists pieces = make_lists(n_boxes, [&](auto&& add) {
        for (const Index f : faces)
            add(piece_of[f], f);
    });
    // All pieces have the same stage (see `grow`), so that any piece may grow into any other; the last label, of faces
    // that are in no piece, has an earlier stage.
    std::vector<Index> stages(usize(n_boxes) + 1, 1);
    stages.back() = 0;
    for (Index p = 0; p < n_boxes; ++p) {
        if (pieces[p].empty())
            continue;
        const MeshPiece piece = cut_out(
            mesh, topology, positions,
            grow(mesh, topology, {piece_of, stages, sizes.overlap}, p, {pieces[p].begin(), pieces[p].end()}), exec);
        is_own.resize(piece.faces.size());
        for_each(exec, piece.mesh.n_faces(), [&](Index i) { is_own[i] = piece_of[piece.faces[i]] == p ? 1 : 0; });
        action(piece, is_own);
    }
}

}  // namespace seamflow
