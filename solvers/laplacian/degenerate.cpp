#include "solvers/laplacian/degenerate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <string>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Whether the squared length of an edge neither vanishes nor overflows: the length is then a normal double.
bool has_length(const Point& edge)
{
    const double square = edge.squaredNorm();
    return square > 0.0 && std::isfinite(square);
}

/// The first corner of face f at which an edge without a valid length begins, if `matters` is true for one of the
/// edge's ends; -1 if there is none.
template <class Matters>
Index edge_without_length(const PolygonMesh& mesh, Index f, Matters&& matters)
{
    const auto corners = mesh.face(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index start = corners[k];
        const Index end = corners[k + 1 < corners.size() ? k + 1 : 0];
        if (!has_length(mesh.vertices.row(end) - mesh.vertices.row(start)) && (matters(start) || matters(end)))
            return static_cast<Index>(k);
    }
    return -1;
}

/// Throws the InputError for an edge without length.
/// @param corner the corner of face f at which the edge begins.
[[noreturn]] void refuse_edge(const PolygonMesh& mesh, Index f, Index corner)
{
    const auto corners = mesh.face(f);
    throw InputError("vertices " + std::to_string(corners[corner]) + " and " +
                     std::to_string(corners[(usize(corner) + 1) % corners.size()]) +
                     " (numbered from 0) are joined by an edge of face " + std::to_string(f) +
                     " and lie at the same place, or so near or far that their distance is not a normal double: merge "
                     "them, move one, or scale the mesh");
}

/// Throws the InputError for a face without area.
/// @param instead a further remedy.
[[noreturn]] void refuse_face(Index f, const std::string& instead)
{
    throw InputError("face " + std::to_string(f) +
                     " (numbered from 0) has no area, up to rounding: remove it, move one of its vertices, or " +
                     instead);
}

/// Appends the vertices that may move and whose rows divide by the length of an edge of face f, or by its area, if that
/// is no valid divisor. Rows of Ptáčková-Velho also reach the faces across the edges of a vertex's faces.
void append_vertices_without_row(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, Index f,
                                 std::vector<Index>& vertices)
{
    const LaplacianTraits& traits = traits_of(laplacian);
    const std::span<const Index> face = mesh.face(f);
    const auto append = [&](std::span<const Index> corners) {
        std::ranges::copy_if(corners, std::back_inserter(vertices), [&](Index v) { return topology.moves(v); });
    };
    if (traits.divisor == Divisor::EdgeLengths)
        for (std::size_t k = 0; k < face.size(); ++k) {
            const std::array ends{face[k], face[k + 1 < face.size() ? k + 1 : 0]};
            if (!has_length(mesh.vertices.row(ends[1]) - mesh.vertices.row(ends[0])))
                append(ends);
        }
    if (traits.divisor != Divisor::FaceAreas || has_area(face, mesh.vertices))
        return;
    append(face);
    if (traits.reach != Reach::TwoRings)
        return;
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h)
        if (const Index twin = topology.twin[h]; twin >= 0)
            append(mesh.face(topology.face_of[twin]));
}

/// The faces whose edges or areas are invalid divisors in the row of a vertex that may move.
std::vector<Index> degenerate_faces(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                    const Executor& exec)
{
    if (traits_of(laplacian).divisor == Divisor::Nothing)
        return {};
    return select(exec, mesh.n_faces(), [&](Index f) {
        std::vector<Index> vertices;
        append_vertices_without_row(mesh, topology, laplacian, f, vertices);
        return !vertices.empty();
    });
}

}  // namespace

std::vector<Index> vertices_without_row(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                        const Executor& exec)
{
    std::vector<Index> vertices;
    for (const Index f : degenerate_faces(mesh, topology, laplacian, exec))
        append_vertices_without_row(mesh, topology, laplacian, f, vertices);
    sort_unique(vertices);
    return vertices;
}

void require_sound_geometry(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                            const Executor& exec)
{
    const auto bad = degenerate_faces(mesh, topology, laplacian, exec);
    if (bad.empty())
        return;
    if (traits_of(laplacian).divisor == Divisor::EdgeLengths)
        refuse_edge(mesh, bad.front(),
                    edge_without_length(mesh, bad.front(), [&](Index v) { return topology.moves(v); }));
    refuse_face(bad.front(), "use the Laplacian fujiwara, which does not divide by areas");
}

void require_sizes(const PolygonMesh& mesh, const Executor& exec)
{
    const auto bad_edge = [&](Index f) { return edge_without_length(mesh, f, [](Index) { return true; }); };
    const auto bad = select(exec, mesh.n_faces(),
                            [&](Index f) { return bad_edge(f) >= 0 || !has_area(mesh.face(f), mesh.vertices); });
    if (bad.empty())
        return;
    if (const Index corner = bad_edge(bad.front()); corner >= 0)
        refuse_edge(mesh, bad.front(), corner);
    refuse_face(bad.front(), "leave strict out");
}

}  // namespace seamflow
