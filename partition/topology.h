#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The kind of a vertex, by the faces around it.
enum class VertexKind : std::uint8_t {
    /// The faces of the vertex form one closed fan.
    Interior,
    /// The vertex is on an edge of one face and, before free_junctions, on none of three or more.
    Boundary,
    /// The vertex is on an edge of three or more faces, or its faces form several fans, none of them open.
    NonManifold,
    /// The vertex is on edges of three or more faces, but on no edge of one face; only after free_junctions.
    Junction,
    /// The vertex has no faces.
    Isolated,
};

/// The face of every half-edge. If all faces have equally many corners, it is computed and not stored.
class FaceOfHalfedge {
  public:
    FaceOfHalfedge() = default;
    FaceOfHalfedge(const PolygonMesh& mesh, const Executor& exec);

    Index operator[](std::size_t h) const
    {
        return degree_ > 0 ? static_cast<Index>(h * multiplier_ >> shift_) : faces_[h];
    }

    /// The half-edge after h in its face.
    [[nodiscard]] Index next(const PolygonMesh& mesh, Index h) const
    {
        const Index f = (*this)[h];
        if (degree_ > 0)
            return h + 1 == (f + 1) * degree_ ? h + 1 - degree_ : h + 1;
        return h + 1 == mesh.face_offsets[f + 1] ? mesh.face_offsets[f] : h + 1;
    }

    /// The half-edge before h in its face.
    [[nodiscard]] Index previous(const PolygonMesh& mesh, Index h) const
    {
        const Index f = (*this)[h];
        if (degree_ > 0)
            return h == f * degree_ ? h + degree_ - 1 : h - 1;
        return h == mesh.face_offsets[f] ? mesh.face_offsets[f + 1] - 1 : h - 1;
    }

  private:
    /// The number of corners of every face; 0 if they differ.
    Index degree_ = 0;
    /// A half-edge divided by the degree is its product with `multiplier_`, shifted right by `shift_`.
    std::uint64_t multiplier_ = 0;
    int shift_ = 0;
    /// One entry per half-edge, if the numbers of corners differ.
    std::vector<Index> faces_;
};

/// A half-edge at an edge of three or more faces, with the previous and the next half-edge at that edge: half-edges
/// follow each other in ascending order, and the highest is followed by the lowest.
struct JunctionLink {
    Index halfedge;
    Index next;
    Index previous;
    /// The number of faces that share the edge.
    Index n_faces;
};

/// The connectivity of the faces of a mesh. Half-edge h runs from corner h to the next corner of the same face, so that
/// half-edges are numbered like `face_vertices`. Orientation does not matter: an edge pairs its two half-edges whether
/// they run in opposite directions or in the same direction, so that a Möbius band is a valid mesh.
struct Topology {
    /// One entry per half-edge: the half-edge of the other face at the same edge; -1 at an edge of one face, or of
    /// three or more.
    std::vector<Index> twin;
    FaceOfHalfedge face_of;
    /// #V + 1; the corners at vertex v are vertex_corners[vertex_offsets[v]] and so on, in ascending order.
    std::vector<Index> vertex_offsets;
    std::vector<Index> vertex_corners;
    /// #V: the kind of each vertex.
    std::vector<VertexKind> kind;
    /// #V: 1 for vertices that a flow does not move. Initially 1 except at interior vertices; see free_boundary,
    /// free_junctions and fix_vertices.
    std::vector<std::uint8_t> fixed;
    /// Every half-edge at a junction, ascending; empty before free_junctions. Faces that meet there are then connected.
    std::vector<JunctionLink> junctions;
    /// Whether the two half-edges of every pair run in opposite directions.
    bool oriented = true;

    /// Whether a flow moves vertex v.
    [[nodiscard]] bool moves(Index v) const { return fixed[v] == 0; }

    /// The index of half-edge h in `junctions`; -1 if h is at no junction. Logarithmic in the number of junctions.
    [[nodiscard]] Index junction_index(Index h) const;

    /// The half-edge that follows h at a junction (see JunctionLink); h itself elsewhere.
    [[nodiscard]] Index next_at_junction(Index h) const;

    /// The corners at vertex v, one in each of its faces.
    [[nodiscard]] std::span<const Index> corners_at(Index v) const
    {
        const std::size_t begin = usize(vertex_offsets[v]);
        return std::span<const Index>(vertex_corners).subspan(begin, usize(vertex_offsets[v + 1]) - begin);
    }

    /// The half-edge after h in its face.
    [[nodiscard]] Index next(const PolygonMesh& mesh, Index h) const { return face_of.next(mesh, h); }

    /// The half-edge before h in its face.
    [[nodiscard]] Index previous(const PolygonMesh& mesh, Index h) const { return face_of.previous(mesh, h); }
};

/// Pairs the half-edges of a valid mesh (see require_valid) and classifies its vertices. Linear in the size of the
/// mesh.
Topology make_topology(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The length of the edge of half-edge h, bitwise equal for its twin.
inline double edge_length(const PolygonMesh& mesh, const Topology& topology, Index h)
{
    const auto& v = mesh.face_vertices;
    return (mesh.vertices.row(v[topology.next(mesh, h)]) - mesh.vertices.row(v[h])).norm();
}

/// Lets the vertices of kind Boundary move.
void free_boundary(Topology& topology);

/// Lets vertices at junctions, the edges of three faces or more, move: they become of kind Junction, or, where such an
/// edge ends on the boundary, of kind Boundary, which only free_boundary lets move. Vertices at which several fans
/// merely touch stay fixed, because these are usually a defect. Faces at junctions become connected (see
/// Topology::junctions). To be called before free_boundary.
void free_junctions(const PolygonMesh& mesh, Topology& topology, const Executor& exec = run_serially);

/// The vertices that share an edge with v, ascending.
std::vector<Index> neighbours_of(const PolygonMesh& mesh, const Topology& topology, Index v);

/// Lists the vertices at the other ends of the edges at v, ascending: also v itself, if a face names it twice in turn.
void edge_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v, std::vector<Index>& neighbours);

/// Fixes these vertices, whatever their kind.
/// @param vertices in any order, repetitions are allowed.
/// @throws InputError naming the first number out of range.
void fix_vertices(Topology& topology, std::span<const Index> vertices);

/// A run of faces around a vertex, in which each face shares an edge at the vertex with the next face.
struct Fan {
    /// One corner at the vertex per face, in order around the vertex.
    std::vector<Index> corners;
    /// The neighbours of the vertex along the first and the last edge of the fan; the same neighbour if the fan is
    /// closed.
    Index first = -1;
    Index last = -1;
    bool closed = false;
};

/// The neighbours Fan::first and Fan::last, without the list of corners, of the fan at v that contains corner `start`,
/// made of faces with the label of that corner's face.
/// @param start the lowest corner of the fan. @param labels #F.
std::pair<Index, Index> ends_of_fan(const PolygonMesh& mesh, const Topology& topology, Index start,
                                    std::span<const Index> labels);

/// The fans formed by the faces at vertex v with label `label`, in order of their lowest corner.
/// @param labels #F; empty: all faces have the label 0.
std::vector<Fan> fans_at(const PolygonMesh& mesh, const Topology& topology, Index v, std::span<const Index> labels,
                         Index label);

}  // namespace seamflow
