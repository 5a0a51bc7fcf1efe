#include "engine/distributed/parts/deal.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/parts/number_set.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// How many corners the faces of a sub-mesh have in some range.
struct SubMeshCost {
    Index label;
    std::int64_t corners;
};

void require_labels(const RankSlice& slice, std::int64_t first_face)
{
    for (Index f = 0; f < slice.n_faces(); ++f)
        if (slice.labels[f] < 0)
            throw InputError(fmt::format("face {} (numbered from 0) has the label {}: labels must be at least 0",
                                         first_face + f, slice.labels[f]));
}

/// Adds up the costs of each label, ascending.
std::vector<SubMeshCost> summed(std::vector<SubMeshCost> costs)
{
    std::ranges::stable_sort(costs, {}, &SubMeshCost::label);
    std::vector<SubMeshCost> sums;
    for (const SubMeshCost& cost : costs) {
        if (sums.empty() || sums.back().label != cost.label)
            sums.push_back({cost.label, 0});
        sums.back().corners += cost.corners;
    }
    return sums;
}

/// The owners of the sub-meshes: the first label of each rank, ascending.
class Owners {
  public:
    Owners(Communicator& comm, const RankSlice& slice)
    {
        std::vector<SubMeshCost> own;
        for (Index f = 0; f < slice.n_faces(); ++f) {
            if (own.empty() || own.back().label != slice.labels[f])
                own.push_back({slice.labels[f], 0});
            own.back().corners += slice.face_offsets[f + 1] - slice.face_offsets[f];
        }
        const std::vector<SubMeshCost> all = summed(comm.gather_all(summed(std::move(own))));
        std::int64_t total = 0;
        for (const SubMeshCost& cost : all)
            total += cost.corners;
        // A sub-mesh belongs to the rank in whose share its middle lies.
        std::int64_t before = 0;
        for (const SubMeshCost& cost : all) {
            const std::int64_t middle = before + cost.corners / 2;
            labels_.push_back(cost.label);
            ranks_.push_back(static_cast<int>(static_cast<double>(middle) / static_cast<double>(total) * comm.size()));
            before += cost.corners;
        }
    }

    [[nodiscard]] int operator[](Index label) const { return ranks_[place_in(labels_, label)]; }

  private:
    std::vector<Index> labels_;
    std::vector<int> ranks_;
};

/// Packs the faces of a range for their ranks.
/// @tparam Number can hold all numbers of the whole mesh.
template <class Number>
std::vector<Bytes> pack_faces(const RankSlice& slice, const Owners& owners, std::int64_t first_face, int n_ranks)
{
    std::vector<std::vector<Index>> faces(n_ranks);
    for (Index f = 0, owner = 0; f < slice.n_faces(); ++f) {
        if (f == 0 || slice.labels[f] != slice.labels[f - 1])
            owner = owners[slice.labels[f]];
        faces[owner].push_back(f);
    }
    const auto size_of = [&](Index f) { return slice.face_offsets[f + 1] - slice.face_offsets[f]; };
    std::vector<Bytes> packed_faces;
    for (const auto& of_rank : faces) {
        std::size_t n_corners = 0;
        for (const Index f : of_rank)
            n_corners += at(size_of(f));
        Packer packer;
        packer.reserve(2 * sizeof(std::size_t) + of_rank.size() * (sizeof(Number) + 2 * sizeof(Index)) +
                       n_corners * sizeof(Number));
        packer.put(of_rank.size());
        for (const Index f : of_rank) {
            packer.put(static_cast<Number>(first_face + f));
            packer.put(slice.labels[f]);
            packer.put(size_of(f));
        }
        packer.put(n_corners);
        for (const Index f : of_rank)
            for (Index c = slice.face_offsets[f]; c < slice.face_offsets[f + 1]; ++c)
                packer.put(static_cast<Number>(slice.corners[c]));
        packed_faces.push_back(packer.take());
    }
    return packed_faces;
}

/// Faces arrive from the ranks in ascending order of their numbers.
/// @returns their corners, numbered in the whole mesh.
template <class Number>
std::vector<Number> unpack_faces(std::vector<Bytes> packed_faces, MeshPart& part)
{
    std::vector<Number> corners;
    for (Bytes& bytes : packed_faces) {
        Unpacker unpacker(bytes);
        const auto n = unpacker.get<std::size_t>();
        part.face_numbers.reserve(part.face_numbers.size() + n);
        part.labels.reserve(part.labels.size() + n);
        part.mesh.face_offsets.reserve(part.mesh.face_offsets.size() + n);
        for (std::size_t f = 0; f < n; ++f) {
            part.face_numbers.push_back(unpacker.get<Number>());
            part.labels.push_back(unpacker.get<Index>());
            part.mesh.face_offsets.push_back(part.mesh.face_offsets.back() + unpacker.get<Index>());
        }
        unpacker.append_all(corners);
        bytes = {};
    }
    return corners;
}

/// Renumbers corners as vertices of the part.
void number_corners(const std::vector<std::int64_t>& corners, const NumberSet<std::int64_t>& vertices,
                    std::vector<Index>& face_vertices)
{
    face_vertices.resize(corners.size());
    for_each(run_in_parallel, static_cast<Index>(corners.size()),
             [&](Index c) { face_vertices[c] = vertices.place_of(corners[c]); });
}

void number_corners(std::vector<Index>& corners, const NumberSet<Index>& vertices, std::vector<Index>& face_vertices)
{
    for_each(run_in_parallel, static_cast<Index>(corners.size()),
             [&](Index c) { corners[c] = vertices.place_of(corners[c]); });
    face_vertices = std::move(corners);
}

/// @returns without positions.
template <class Number>
MeshPart deal_faces(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds)
{
    const Owners owners(comm, slice);
    MeshPart part;
    auto corners = unpack_faces<Number>(
        comm.exchange(pack_faces<Number>(slice, owners, bounds.faces[comm.rank()], comm.size())), part);
    const NumberSet<Number> vertices(corners);
    const std::vector<Number> numbers = vertices.numbers();
    part.vertex_numbers.assign(numbers.begin(), numbers.end());
    number_corners(corners, vertices, part.mesh.face_vertices);
    return part;
}

}  // namespace

void require_corners(const RankSlice& slice, const SliceBounds& bounds, int rank)
{
    const auto found = std::ranges::find_if(
        slice.corners, [n = bounds.vertices.back()](std::int64_t corner) { return corner < 0 || corner >= n; });
    if (found == slice.corners.end())
        return;
    const auto f = std::ranges::upper_bound(slice.face_offsets, found - slice.corners.begin()) - 1;
    throw InputError(fmt::format("face {} (numbered from 0) names vertex {}, but the mesh has {} vertices",
                                 bounds.faces[rank] + (f - slice.face_offsets.begin()), *found,
                                 bounds.vertices.back()));
}

int range_of(std::span<const std::int64_t> bounds, std::int64_t number)
{
    return static_cast<int>(std::ranges::upper_bound(bounds, number) - bounds.begin()) - 1;
}

void fetch_rows(Communicator& comm, const RowsOfRange& rows, std::span<const std::int64_t> numbers,
                std::span<const std::int64_t> bounds, std::span<double> fetched)
{
    const std::int64_t first = bounds[comm.rank()];
    const auto row_of = [&](std::int64_t number) { return rows.numbers.data() + rows.width * (number - first); };
    std::vector<Bytes> questions;
    // Where the answer of each rank is stored.
    std::vector<double*> places;
    for (auto begin = numbers.begin(); const std::int64_t bound : bounds.subspan(1)) {
        const auto end = std::lower_bound(begin, numbers.end(), bound);
        const bool is_own = static_cast<int>(places.size()) == comm.rank();
        double* const place = fetched.data() + rows.width * (begin - numbers.begin());
        places.push_back(place);
        questions.push_back(is_own ? Bytes() : packed(std::span(begin, end)));
        if (is_own)
            for_each(run_in_parallel, static_cast<Index>(end - begin),
                     [&](Index i) { std::copy_n(row_of(begin[i]), rows.width, place + rows.width * i); });
        begin = end;
    }
    std::vector<Bytes> answers;
    for (const Bytes& question : comm.exchange(std::move(questions))) {
        Packer packer;
        if (!question.empty()) {
            const auto asked = unpacked<std::int64_t>(question);
            packer.reserve(asked.size() * static_cast<std::size_t>(rows.width) * sizeof(double));
            for (const std::int64_t number : asked)
                for (const double value : std::span(row_of(number), static_cast<std::size_t>(rows.width)))
                    packer.put(value);
        }
        answers.push_back(packer.take());
    }
    for (auto place = places.begin(); const Bytes& answer : comm.exchange(std::move(answers))) {
        if (!answer.empty())
            std::memcpy(*place, answer.data(), answer.size());
        ++place;
    }
}

Points fetch_positions(Communicator& comm, const RankSlice& slice, std::span<const std::int64_t> numbers,
                       std::span<const std::int64_t> bounds)
{
    Points positions(static_cast<Eigen::Index>(numbers.size()), 3);
    const auto n = static_cast<std::size_t>(slice.vertices.size());
    fetch_rows(comm, {std::span<const double>(slice.vertices.data(), n), 3}, numbers, bounds,
               std::span(positions.data(), static_cast<std::size_t>(positions.size())));
    return positions;
}

SliceBounds gather_bounds(Communicator& comm, const RankSlice& slice)
{
    SliceBounds bounds{{0}, {0}};
    for (const std::int64_t n : comm.gather_all(std::vector<std::int64_t>{slice.vertices.rows()}))
        bounds.vertices.push_back(bounds.vertices.back() + n);
    for (const std::int64_t n : comm.gather_all(std::vector<std::int64_t>{slice.n_faces()}))
        bounds.faces.push_back(bounds.faces.back() + n);
    return bounds;
}

MeshPart deal(Communicator& comm, const RankSlice& slice, std::int64_t short_up_to)
{
    const SliceBounds bounds = gather_bounds(comm, slice);
    require_corners(slice, bounds, comm.rank());
    require_labels(slice, bounds.faces[comm.rank()]);
    // Meanwhile, most of what a rank holds and sends is numbers.
    MeshPart part = std::max(bounds.vertices.back(), bounds.faces.back()) <= short_up_to
                        ? deal_faces<Index>(comm, slice, bounds)
                        : deal_faces<std::int64_t>(comm, slice, bounds);
    part.mesh.vertices = fetch_positions(comm, slice, part.vertex_numbers, bounds.vertices);
    return part;
}

void collect_positions(Communicator& comm, std::span<const std::int64_t> numbers, const Points& positions,
                       RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(comm, slice);
    const std::int64_t first = bounds.vertices[comm.rank()];
    std::vector<Packer> to_each(comm.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        const auto row = positions.row(static_cast<Eigen::Index>(v));
        const int rank = range_of(bounds.vertices, numbers[v]);
        if (rank == comm.rank()) {
            slice.vertices.row(numbers[v] - first) = row;
            continue;
        }
        to_each[rank].put(numbers[v]);
        to_each[rank].put_row(row.data());
    }
    std::vector<Bytes> bytes;
    for (Packer& packer : to_each)
        bytes.push_back(packer.take());
    for (const Bytes& received : comm.exchange(std::move(bytes)))
        for (Unpacker unpacker(received); !unpacker.is_at_end();) {
            const auto vertex = unpacker.get<std::int64_t>() - first;
            for (int c = 0; c < 3; ++c)
                slice.vertices(vertex, c) = unpacker.get<double>();
        }
}

}  // namespace seamflow
