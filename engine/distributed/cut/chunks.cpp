#include "engine/distributed/cut/chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "engine/distributed/cut/hilbert.h"
#include "engine/distributed/parts/corner_positions.h"
#include "engine/distributed/parts/number_set.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// #F of the range by 3.
Points centroids_of(const RankSlice& slice, const CornerPositions& positions)
{
    Points centroids(slice.n_faces(), 3);
    for_each(run_in_parallel, slice.n_faces(), [&](Index f) {
        // Sorted, so that faces that repeat each other have the same centroid.
        const auto begin = slice.corners.begin() + slice.face_offsets[f];
        std::vector<Number> corners(begin, slice.corners.begin() + slice.face_offsets[f + 1]);
        std::ranges::sort(corners);
        Point sum = Point::Zero();
        for (const Number corner : corners)
            sum += positions[corner];
        centroids.row(f) = sum / std::max(1, slice.face_offsets[f + 1] - slice.face_offsets[f]);
    });
    return centroids;
}

/// Low and high corner of the box around the points of all ranks; those that are not finite do not count.
std::array<Point, 2> box_of(Communicator& comm, const Points& points)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<Point, 2> box{Point::Constant(infinity), Point::Constant(-infinity)};
    const auto take_in = [&](const Point& point) {
        if (!point.allFinite())
            return;
        box[0] = box[0].cwiseMin(point);
        box[1] = box[1].cwiseMax(point);
    };
    for (const auto& point : points.rowwise())
        take_in(point);
    const std::vector<double> all =
        comm.gather_all(std::vector<double>{box[0].x(), box[0].y(), box[0].z(), box[1].x(), box[1].y(), box[1].z()});
    for (std::size_t i = 0; i < all.size(); i += 3)
        take_in({all[i], all[i + 1], all[i + 2]});
    return box;
}

/// #F of the range.
std::vector<std::uint64_t> hilbert_codes(Communicator& comm, const Points& centroids)
{
    const auto [low, high] = box_of(comm, centroids);
    const double side = (high - low).maxCoeff();
    constexpr double n_cells = std::uint32_t{1} << hilbert_bits;
    const Point origin = low;
    std::vector<std::uint64_t> codes(static_cast<std::size_t>(centroids.rows()));
    for_each(run_in_parallel, static_cast<Index>(codes.size()), [&](Index f) {
        std::array<std::uint32_t, 3> cell{};
        for (int c = 0; c < 3; ++c) {
            const double place = (centroids(f, c) - origin[c]) / side * n_cells;
            cell[c] = place > 0.0 ? static_cast<std::uint32_t>(std::min(place, n_cells - 1.0)) : 0;
        }
        codes[f] = hilbert_code(cell);
    });
    return codes;
}

/// For each number, the largest code below which all ranks have at most that many faces.
/// @param sorted the codes of this rank.
std::vector<std::uint64_t> codes_at(Communicator& comm, const std::vector<std::uint64_t>& sorted,
                                    const std::vector<Number>& numbers)
{
    std::vector<std::uint64_t> codes(numbers.size(), 0);
    for (int bit = 3 * hilbert_bits - 1; bit >= 0; --bit) {
        std::vector<Number> counts;
        for (const std::uint64_t code : codes)
            counts.push_back(std::ranges::lower_bound(sorted, code | std::uint64_t{1} << bit) - sorted.begin());
        const std::vector<Number> of_all = comm.gather_all(counts);
        for (std::size_t i = 0; i < codes.size(); ++i) {
            Number count = 0;
            for (std::size_t k = i; k < of_all.size(); k += codes.size())
                count += of_all[k];
            if (count <= numbers[i])
                codes[i] |= std::uint64_t{1} << bit;
        }
    }
    return codes;
}

/// Sends numbers to their homes, the ranks whose ranges contain them, and gets an answer to each.
/// @param numbers #numbers; each with a home. @param home_of the home of a question.
/// @param answer called at each home with all questions that arrived there; returns one answer to each.
template <class Question, class HomeOf, class Answer>
std::vector<std::uint8_t> ask_homes(Communicator& comm, const std::vector<Question>& questions, HomeOf&& home_of,
                                    Answer&& answer)
{
    std::vector<std::vector<Question>> to_homes(comm.size());
    for (const Question& question : questions)
        to_homes[home_of(question)].push_back(question);
    std::vector<Bytes> sent;
    for (auto& of_home : to_homes)
        sent.push_back(packed(std::exchange(of_home, {})));
    std::vector<Question> asked;
    std::vector<std::size_t> ends;
    for (const Bytes& bytes : comm.exchange(std::move(sent))) {
        const auto of_rank = unpacked<Question>(bytes);
        asked.insert(asked.end(), of_rank.begin(), of_rank.end());
        ends.push_back(asked.size());
    }
    const std::vector<std::uint8_t> answers = answer(asked);
    std::vector<Bytes> replies;
    for (std::size_t rank = 0, begin = 0; rank < ends.size(); begin = ends[rank++])
        replies.push_back(packed(std::vector<std::uint8_t>(answers.begin() + static_cast<std::ptrdiff_t>(begin),
                                                           answers.begin() + static_cast<std::ptrdiff_t>(ends[rank]))));
    std::vector<std::vector<std::uint8_t>> from_homes;
    for (const Bytes& bytes : comm.exchange(std::move(replies)))
        from_homes.push_back(unpacked<std::uint8_t>(bytes));
    std::vector<std::size_t> next(from_homes.size(), 0);
    std::vector<std::uint8_t> result;
    for (const Question& question : questions) {
        const int home = home_of(question);
        result.push_back(from_homes[home][next[home]++]);
    }
    return result;
}

/// How often each value occurs, up to 3.
template <class Value>
std::vector<std::uint8_t> counts_of(const std::vector<Value>& values)
{
    std::vector<Value> sorted = values;
    std::ranges::sort(sorted);
    std::vector<std::uint8_t> counts;
    for (const Value& value : values) {
        const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), value);
        counts.push_back(static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(last - first, 3)));
    }
    return counts;
}

void find_shared_vertices(Communicator& comm, const SliceBounds& bounds, std::vector<Chunk>& chunks)
{
    std::vector<Number> vertices;
    for (const Chunk& chunk : chunks)
        vertices.insert(vertices.end(), chunk.part.vertex_numbers.begin(), chunk.part.vertex_numbers.end());
    const Number first = bounds.vertices[comm.rank()];
    const auto counts_at_home = [&](const std::vector<Number>& asked) {
        std::vector<std::uint8_t> n_chunks(bounds.vertices[comm.rank() + 1] - first, 0);
        for (const Number vertex : asked)
            n_chunks[vertex - first] = n_chunks[vertex - first] > 0 ? 2 : 1;
        std::vector<std::uint8_t> counts;
        for (const Number vertex : asked)
            counts.push_back(n_chunks[vertex - first]);
        return counts;
    };
    const std::vector<std::uint8_t> counts = ask_homes(
        comm, vertices, [&](Number vertex) { return range_of(bounds.vertices, vertex); }, counts_at_home);
    auto next = counts.begin();
    for (Chunk& chunk : chunks)
        for (std::size_t v = 0; v < chunk.part.vertex_numbers.size(); ++v)
            chunk.is_shared.push_back(*next++ > 1 ? 1 : 0);
}

/// The ends of an edge in the whole mesh.
struct EdgeEnds {
    Number low;
    Number high;
    friend auto operator<=>(const EdgeEnds&, const EdgeEnds&) = default;
};

/// The half-edges of a chunk whose ends are both shared.
std::vector<Index> halfedges_at_others(const Chunk& chunk)
{
    const PolygonMesh& mesh = chunk.part.mesh;
    return select(run_in_parallel, mesh.n_corners(), [&](Index h) {
        return chunk.is_shared[mesh.face_vertices[h]] != 0 &&
               chunk.is_shared[mesh.face_vertices[chunk.topology.next(mesh, h)]] != 0;
    });
}

EdgeEnds edge_of(const Chunk& chunk, Index h)
{
    const PolygonMesh& mesh = chunk.part.mesh;
    const Number one = chunk.part.vertex_numbers[mesh.face_vertices[h]];
    const Number other = chunk.part.vertex_numbers[mesh.face_vertices[chunk.topology.next(mesh, h)]];
    return {std::min(one, other), std::max(one, other)};
}

/// Finds the edges to other chunks, and leaves no twins at edges that have a third face there.
void match_edges(Communicator& comm, const SliceBounds& bounds, std::vector<Chunk>& chunks)
{
    std::vector<EdgeEnds> edges;
    for (const Chunk& chunk : chunks)
        for (const Index h : halfedges_at_others(chunk))
            edges.push_back(edge_of(chunk, h));
    const std::vector<std::uint8_t> n_faces = ask_homes(
        comm, edges, [&](const EdgeEnds& edge) { return range_of(bounds.vertices, edge.low); }, counts_of<EdgeEnds>);
    auto next = n_faces.begin();
    for (Chunk& chunk : chunks)
        for (const Index h : halfedges_at_others(chunk)) {
            const int n = *next++;
            if (chunk.topology.twin[h] < 0 && n == 2)
                chunk.crossing.push_back(h);
            if (n > 2) {
                chunk.topology.twin[h] = -1;
                chunk.topology.kind[chunk.part.mesh.face_vertices[h]] = VertexKind::NonManifold;
            }
        }
}

}  // namespace

void label_chunks(Communicator& comm, RankSlice& slice, const SliceBounds& bounds, Index size)
{
    const std::vector<std::uint64_t> codes =
        hilbert_codes(comm, centroids_of(slice, CornerPositions(comm, slice, bounds)));
    std::vector<Number> begins;
    for (Number begin = size; begin < bounds.faces.back(); begin += size)
        begins.push_back(begin);
    std::vector<std::uint64_t> sorted = codes;
    std::ranges::sort(sorted);
    const std::vector<std::uint64_t> first_codes = codes_at(comm, sorted, begins);
    slice.labels.resize(codes.size());
    for_each(run_in_parallel, slice.n_faces(), [&](Index f) {
        slice.labels[f] = static_cast<Index>(std::ranges::upper_bound(first_codes, codes[f]) - first_codes.begin());
    });
}

std::vector<Chunk> deal_chunks(Communicator& comm, RankSlice& slice, const SliceBounds& bounds)
{
    std::vector<Chunk> chunks;
    {
        const MeshPart part = deal(comm, slice);
        slice.labels = {};
        const NumberSet numbers(part.labels);
        const IndexLists faces = make_lists(numbers.size(), [&](auto&& add) {
            for (Index f = 0; f < part.mesh.n_faces(); ++f)
                add(numbers.place_of(part.labels[f]), f);
        });
        chunks.resize(at(numbers.size()));
        for_each(run_in_parallel, faces.size(), [&](Index i) {
            chunks[i].part = some_faces(part, faces[i]);
            chunks[i].topology = make_topology(chunks[i].part.mesh);
        });
    }
    find_shared_vertices(comm, bounds, chunks);
    match_edges(comm, bounds, chunks);
    return chunks;
}

}  // namespace seamflow
