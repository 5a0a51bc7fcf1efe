#include "solvers/systems/whole_mesh_rows.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "partition/cut/boxes.h"
#include "partition/large_arrays.h"

namespace seamflow {

namespace {

/// The most blocks. 64 keep as many threads busy; smaller blocks leave more entries out of the preconditioner.
constexpr Index most_blocks = 64;
/// The fewest rows of a block, and the usual number of rows where there are more blocks.
constexpr Index fewest_rows = 512;
constexpr Index usual_rows = BlockRowMatrix::most_rows / 2;
/// The most edges between blocks, as a fraction of all edges.
constexpr double most_between_blocks = 1.0 / 6.0;

/// The number of blocks for this many rows: a power of two.
Index number_of_blocks(Index n_rows)
{
    const Index wanted = std::max(std::min(n_rows / fewest_rows, most_blocks), n_rows / usual_rows);
    return static_cast<Index>(std::bit_floor(static_cast<unsigned>(std::max(wanted, 1))));
}

/// Blocks of the vertices in the order of their numbers.
IndexLists consecutive_blocks(Index n_rows, Index n_blocks)
{
    IndexLists blocks;
    blocks.values = large_vector<Index>(usize(n_rows));
    std::iota(blocks.values.begin(), blocks.values.end(), 0);
    for (Index block = 1; block <= n_blocks; ++block)
        blocks.offsets.push_back(static_cast<Index>(std::int64_t{n_rows} * block / n_blocks));
    return blocks;
}

/// The fraction of the edges of faces whose ends are in different blocks.
/// @param blocks of consecutive vertices.
double fraction_between_blocks(const PolygonMesh& mesh, const IndexLists& blocks, const Executor& exec)
{
    auto block_of = large_vector<Index>(usize(mesh.n_vertices()));
    for_each(exec, blocks.size(),
             [&](Index block) { std::fill_n(block_of.begin() + blocks.offsets[block], blocks[block].size(), block); });
    const double n_between = sum(exec, mesh.n_faces(), [&](Index f) {
        const std::span<const Index> face = mesh.face(f);
        double n = block_of[face.back()] != block_of[face.front()] ? 1.0 : 0.0;
        for (std::size_t i = 1; i < face.size(); ++i)
            n += block_of[face[i - 1]] != block_of[face[i]] ? 1.0 : 0.0;
        return n;
    });
    return n_between / static_cast<double>(std::max<std::size_t>(mesh.face_vertices.size(), 1));
}

/// The vertices without faces if most vertices have none, as outside a region that flows alone: they need no rows.
/// Otherwise empty.
std::vector<Index> vertices_without_rows(const Topology& topology, const Executor& exec)
{
    const auto n = static_cast<Index>(topology.kind.size());
    std::vector<Index> isolated = select(exec, n, [&](Index v) { return topology.kind[v] == VertexKind::Isolated; });
    return 2 * isolated.size() > topology.kind.size() ? std::move(isolated) : std::vector<Index>();
}

/// Divides the vertices that have faces into boxes.
IndexLists divide_vertices_of_faces(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const std::vector<Index> vertices =
        select(exec, mesh.n_vertices(), [&](Index v) { return topology.kind[v] != VertexKind::Isolated; });
    const auto n = static_cast<Index>(vertices.size());
    IndexLists blocks = divide_into_boxes(mesh.vertices(vertices, Eigen::all), number_of_blocks(n), exec);
    for (Index& v : blocks.values)
        v = vertices[v];
    return blocks;
}

/// Blocks of consecutive vertices need no set-up, but in most scans neighbours have numbers far apart: then the blocks
/// are boxes.
IndexLists make_blocks(const PolygonMesh& mesh, const Topology& topology, bool have_all_rows, const Executor& exec)
{
    if (!have_all_rows)
        return divide_vertices_of_faces(mesh, topology, exec);
    const Index n = number_of_blocks(mesh.n_vertices());
    IndexLists blocks = consecutive_blocks(mesh.n_vertices(), n);
    if (fraction_between_blocks(mesh, blocks, exec) <= most_between_blocks)
        return blocks;
    return divide_into_boxes(mesh.vertices, n, exec);
}

/// Lists the columns of the row of v, ascending and without v itself.
/// @param along_edges whether the neighbours of v are only those joined to it by edges, or all vertices of its faces.
void list_columns(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& row_of, bool along_edges,
                  Index v, std::vector<Index>& columns)
{
    columns.clear();
    // Whether the vertex after v in each face of v is met once, and these are all vertices that share edges with v.
    const bool next_are_all = topology.oriented && topology.kind[v] == VertexKind::Interior;
    const auto add = [&](Index corner) { columns.push_back(row_of[mesh.face_vertices[corner]]); };
    for (const Index corner : topology.corners_at(v)) {
        if (!along_edges) {
            for (const Index w : mesh.face(topology.face_of[corner]))
                columns.push_back(row_of[w]);
            continue;
        }
        add(topology.next(mesh, corner));
        if (!next_are_all)
            add(topology.previous(mesh, corner));
    }
    sort_unique(columns);
    std::erase(columns, row_of[v]);
}

}  // namespace

WholeMeshRows make_whole_mesh_rows(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    WholeMeshRows rows;
    rows.without_row = vertices_without_rows(topology, exec);
    rows.vertices = make_blocks(mesh, topology, rows.without_row.empty(), exec);
    rows.row_of = large_vector<Index>(usize(mesh.n_vertices()), -1);
    const std::vector<Index>& vertices = rows.vertices.values;
    for_each(exec, static_cast<Index>(vertices.size()), [&](Index i) { rows.row_of[vertices[i]] = i; });
    return rows;
}

BlockRowMatrix make_matrix(const PolygonMesh& mesh, const Topology& topology, const WholeMeshRows& rows, Reach reach,
                           const Executor& exec)
{
    const IndexLists& vertices = rows.vertices;
    const bool along_edges = reach == Reach::Edges || mesh.n_corners() == 3 * mesh.n_faces();
    std::vector<Index> begin{0};
    for (Index block = 0; block < vertices.size(); ++block)
        while (begin.back() < vertices.offsets[block + 1])
            begin.push_back(std::min(begin.back() + BlockRowMatrix::most_rows, vertices.offsets[block + 1]));
    return {begin,
            [&](Index block) {
                std::vector<Index> row;
                IndexLists columns;
                const auto n_rows = usize(begin[block + 1] - begin[block]);
                columns.offsets.reserve(n_rows + 1);
                // In meshes of triangles, a vertex has as many neighbours as corners.
                columns.values.reserve(n_rows * mesh.face_vertices.size() / usize(std::max(mesh.n_vertices(), 1)));
                for (Index i = begin[block]; i < begin[block + 1]; ++i) {
                    if (topology.moves(vertices.values[i])) {
                        list_columns(mesh, topology, rows.row_of, along_edges, vertices.values[i], row);
                        columns.values.insert(columns.values.end(), row.begin(), row.end());
                    }
                    columns.close();
                }
                return columns;
            },
            exec};
}

}  // namespace seamflow
