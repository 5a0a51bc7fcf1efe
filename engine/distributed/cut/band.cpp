#include "engine/distributed/cut/band.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// Sparse numbers, often queried for others.
class SparseNumbers {
  public:
    /// @param numbers ascending; must outlive this.
    explicit SparseNumbers(const std::vector<Number>& numbers)
        : numbers_(numbers)
    {
        constexpr std::size_t bits_per_number = 16;
        std::size_t n_bits = std::size_t{1} << 12;
        while (n_bits < bits_per_number * numbers.size())
            n_bits *= 2;
        may_have_.resize(n_bits, false);
        for (const Number number : numbers)
            may_have_[bit_of(number)] = true;
    }

    [[nodiscard]] bool has(Number number) const
    {
        return may_have_[bit_of(number)] && std::ranges::binary_search(numbers_, number);
    }

  private:
    [[nodiscard]] std::size_t bit_of(Number number) const
    {
        return static_cast<std::size_t>(number) & (may_have_.size() - 1);
    }

    const std::vector<Number>& numbers_;
    /// Whether there is a number with these last digits.
    std::vector<bool> may_have_;
};

/// A face as it is sent.
struct FaceHeader {
    Number number;
    Index label;
    Index n_corners;
};

/// Faces as they arrive, in any order.
struct ArrivedFaces {
    std::vector<FaceHeader> headers;
    /// Where the corners of each begin.
    std::vector<std::size_t> begins;
    std::vector<Number> corners;

    void take(const Bytes& bytes)
    {
        Unpacker unpacker(bytes);
        const auto more = unpacker.get_all<FaceHeader>();
        std::size_t begin = corners.size();
        for (const FaceHeader& header : more) {
            begins.push_back(begin);
            begin += at(header.n_corners);
        }
        headers.insert(headers.end(), more.begin(), more.end());
        const auto of_more = unpacker.get_all<Number>();
        corners.insert(corners.end(), of_more.begin(), of_more.end());
    }

    [[nodiscard]] std::span<const Number> corners_of(std::size_t i) const
    {
        return std::span(corners).subspan(begins[i], at(headers[i].n_corners));
    }
};

/// The faces of a range that have a corner among some vertices.
Bytes pack_faces_at(const RankSlice& slice, Number first_face, const SparseNumbers& vertices,
                    std::vector<std::uint8_t>& is_sent)
{
    const auto faces = select(run_in_parallel, slice.n_faces(), [&](Index f) {
        const auto corners =
            std::span(slice.corners)
                .subspan(at(slice.face_offsets[f]), at(slice.face_offsets[f + 1] - slice.face_offsets[f]));
        return is_sent[f] == 0 && std::ranges::any_of(corners, [&](Number corner) { return vertices.has(corner); });
    });
    std::vector<FaceHeader> headers;
    std::vector<Number> corners;
    for (const Index f : faces) {
        is_sent[f] = 1;
        headers.push_back({first_face + f, slice.labels[f], slice.face_offsets[f + 1] - slice.face_offsets[f]});
        corners.insert(corners.end(), slice.corners.begin() + slice.face_offsets[f],
                       slice.corners.begin() + slice.face_offsets[f + 1]);
    }
    Packer packer;
    packer.put_all(std::span<const FaceHeader>(headers));
    packer.put_all(std::span<const Number>(corners));
    return packer.take();
}

/// @returns without positions.
MeshPart part_of(const ArrivedFaces& arrived)
{
    MeshPart part;
    part.vertex_numbers = arrived.corners;
    sort_unique(part.vertex_numbers);
    std::vector<std::size_t> order(arrived.headers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return arrived.headers[i].number; });
    std::vector<Index> corners;
    for (const std::size_t i : order) {
        corners.clear();
        for (const Number corner : arrived.corners_of(i))
            corners.push_back(place_in(part.vertex_numbers, corner));
        part.mesh.add_face(corners);
        part.face_numbers.push_back(arrived.headers[i].number);
        part.labels.push_back(arrived.headers[i].label);
    }
    return part;
}

}  // namespace

Band gather_band(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds,
                 const std::vector<std::int64_t>& vertices, int layers)
{
    ArrivedFaces arrived;
    std::vector<std::uint8_t> is_sent(at(slice.n_faces()), 0);
    // At rank 0, ascending: vertices whose faces have all arrived, and those whose faces are still to come.
    std::vector<Number> inner;
    std::vector<Number> next = vertices;
    for (int layer = 0; layer < layers; ++layer) {
        const std::vector<Number> asked = comm.broadcast(next);
        std::vector<Bytes> to_each(comm.size());
        to_each.front() = pack_faces_at(slice, bounds.faces[comm.rank()], SparseNumbers(asked), is_sent);
        const std::size_t n_before = arrived.corners.size();
        for (const Bytes& bytes : comm.exchange(std::move(to_each)))
            if (!bytes.empty())
                arrived.take(bytes);
        std::vector<Number> known;
        std::ranges::merge(inner, next, std::back_inserter(known));
        inner = std::move(known);
        std::vector<Number> met(arrived.corners.begin() + static_cast<std::ptrdiff_t>(n_before), arrived.corners.end());
        sort_unique(met);
        next.clear();
        std::ranges::set_difference(met, inner, std::back_inserter(next));
    }
    Band band{.part = part_of(arrived), .is_whole = {}};
    for (const Number vertex : band.part.vertex_numbers)
        band.is_whole.push_back(std::ranges::binary_search(inner, vertex) ? 1 : 0);
    band.part.mesh.vertices = fetch_positions(comm, slice, band.part.vertex_numbers, bounds.vertices);
    return band;
}

}  // namespace seamflow
