#include "engine/distributed/parts/deal.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/parts/number_set.h"
#include "engine/tasks/parallel_loop.h"
#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// So many corners have the faces of a sub-mesh in some stretch.
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

/// Adds up what has the same label, ascending.
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

/// Whose the sub-meshes are: the first label of each rank, ascending.
class Owners {
  public:
    Owners(Conversation& talk, const RankSlice& slice)
    {
        std::vector<SubMeshCost> own;
        for (Index f = 0; f < slice.n_faces(); ++f) {
            if (own.empty() || own.back().label != slice.labels[f])
                own.push_back({slice.labels[f], 0});
            own.back().corners += slice.face_offsets[f + 1] - slice.face_offsets[f];
        }
        const std::vector<SubMeshCost> all = summed(talk.gather_all(summed(std::move(own))));
        std::int64_t total = 0;
        for (const SubMeshCost& cost : all)
            total += cost.corners;
        // A sub-mesh belongs to the rank in whose share its middle lies.
        std::int64_t before = 0;
        for (const SubMeshCost& cost : all) {
            const std::int64_t middle = before + cost.corners / 2;
            labels_.push_back(cost.label);
            ranks_.push_back(static_cast<int>(static_cast<double>(middle) / static_cast<double>(total) * talk.size()));
            before += cost.corners;
        }
    }

    [[nodiscard]] int operator[](Index label) const
    {
        return ranks_[static_cast<std::size_t>(std::ranges::lower_bound(labels_, label) - labels_.begin())];
    }

  private:
    std::vector<Index> labels_;
    std::vector<int> ranks_;
};

/// Gives the faces of a stretch to their ranks.
std::vector<Bytes> pack_faces(const RankSlice& slice, const Owners& owners, std::int64_t first_face, int n_ranks)
{
    std::vector<std::vector<Index>> faces(n_ranks);
    for (Index f = 0, owner = 0; f < slice.n_faces(); ++f) {
        if (f == 0 || slice.labels[f] != slice.labels[f - 1])
            owner = owners[slice.labels[f]];
        faces[owner].push_back(f);
    }
    std::vector<Bytes> packed_faces;
    for (const auto& of_rank : faces) {
        std::vector<std::int64_t> numbers;
        std::vector<Index> labels;
        std::vector<Index> sizes;
        for (const Index f : of_rank) {
            numbers.push_back(first_face + f);
            labels.push_back(slice.labels[f]);
            sizes.push_back(slice.face_offsets[f + 1] - slice.face_offsets[f]);
        }
        const Index n_corners = std::reduce(sizes.begin(), sizes.end());
        Packer packer;
        packer.reserve(4 * sizeof(std::size_t) + of_rank.size() * (sizeof(std::int64_t) + 2 * sizeof(Index)) +
                       at(n_corners) * sizeof(std::int64_t));
        packer.put_all(std::span<const std::int64_t>(numbers));
        packer.put_all(std::span<const Index>(labels));
        packer.put_all(std::span<const Index>(sizes));
        packer.put(at(n_corners));
        for (const Index f : of_rank)
            for (Index c = slice.face_offsets[f]; c < slice.face_offsets[f + 1]; ++c)
                packer.put(slice.corners[c]);
        packed_faces.push_back(packer.take());
    }
    return packed_faces;
}

/// Faces come from the ranks in ascending order of their numbers.
/// @returns their corners, numbered in the whole mesh.
std::vector<std::int64_t> unpack_faces(std::vector<Bytes> packed_faces, MeshPart& part)
{
    std::vector<std::int64_t> corners;
    for (Bytes& bytes : packed_faces) {
        Unpacker unpacker(bytes);
        unpacker.append_all(part.face_numbers);
        unpacker.append_all(part.labels);
        for (const Index size : unpacker.get_all<Index>())
            part.mesh.face_offsets.push_back(part.mesh.face_offsets.back() + size);
        unpacker.append_all(corners);
        bytes = {};
    }
    return corners;
}

}  // namespace

void require_corners(const RankSlice& slice, const SliceBounds& bounds, int rank)
{
    for (Index f = 0; f < slice.n_faces(); ++f)
        for (Index c = slice.face_offsets[f]; c < slice.face_offsets[f + 1]; ++c)
            if (slice.corners[c] < 0 || slice.corners[c] >= bounds.vertices.back())
                throw InputError(fmt::format("face {} (numbered from 0) names vertex {}, but the mesh has {} vertices",
                                             bounds.faces[rank] + f, slice.corners[c], bounds.vertices.back()));
}

int stretch_of(std::span<const std::int64_t> bounds, std::int64_t number)
{
    return static_cast<int>(std::ranges::upper_bound(bounds, number) - bounds.begin()) - 1;
}

Points fetch_positions(Conversation& talk, const RankSlice& slice, std::span<const std::int64_t> numbers,
                       std::span<const std::int64_t> bounds)
{
    std::vector<Bytes> questions;
    for (auto begin = numbers.begin(); const std::int64_t bound : bounds.subspan(1)) {
        const auto end = std::lower_bound(begin, numbers.end(), bound);
        questions.push_back(packed(std::span(begin, end)));
        begin = end;
    }
    std::vector<Bytes> answers;
    for (const Bytes& question : talk.exchange(std::move(questions))) {
        Packer packer;
        const auto asked = unpacked<std::int64_t>(question);
        packer.reserve(asked.size() * 3 * sizeof(double));
        for (const std::int64_t number : asked)
            packer.put_row(slice.vertices.row(number - bounds[talk.rank()]).data());
        answers.push_back(packer.take());
    }
    // Stretches ascend, and so do the numbers within each.
    Points positions(static_cast<Eigen::Index>(numbers.size()), 3);
    double* next = positions.data();
    for (const Bytes& answer : talk.exchange(std::move(answers))) {
        if (!answer.empty())
            std::memcpy(next, answer.data(), answer.size());
        next += answer.size() / sizeof(double);
    }
    return positions;
}

SliceBounds gather_bounds(Conversation& talk, const RankSlice& slice)
{
    SliceBounds bounds{{0}, {0}};
    for (const std::int64_t n : talk.gather_all(std::vector<std::int64_t>{slice.vertices.rows()}))
        bounds.vertices.push_back(bounds.vertices.back() + n);
    for (const std::int64_t n : talk.gather_all(std::vector<std::int64_t>{slice.n_faces()}))
        bounds.faces.push_back(bounds.faces.back() + n);
    return bounds;
}

MeshPart deal(Conversation& talk, const RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(talk, slice);
    require_corners(slice, bounds, talk.rank());
    require_labels(slice, bounds.faces[talk.rank()]);
    const Owners owners(talk, slice);
    MeshPart part;
    const std::vector<std::int64_t> corners =
        unpack_faces(talk.exchange(pack_faces(slice, owners, bounds.faces[talk.rank()], talk.size())), part);
    const NumberSet vertices(corners);
    part.vertex_numbers = vertices.numbers();
    part.mesh.face_vertices.resize(corners.size());
    for_each(run_in_parallel, part.mesh.n_corners(),
             [&](Index c) { part.mesh.face_vertices[c] = vertices.place_of(corners[c]); });
    part.mesh.vertices = fetch_positions(talk, slice, part.vertex_numbers, bounds.vertices);
    return part;
}

void collect_positions(Conversation& talk, std::span<const std::int64_t> numbers, const Points& positions,
                       RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(talk, slice);
    std::vector<Packer> to_each(talk.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        Packer& packer = to_each[stretch_of(bounds.vertices, numbers[v])];
        packer.put(numbers[v]);
        packer.put_row(positions.row(static_cast<Eigen::Index>(v)).data());
    }
    std::vector<Bytes> bytes;
    for (Packer& packer : to_each)
        bytes.push_back(packer.take());
    for (const Bytes& received : talk.exchange(std::move(bytes)))
        for (Unpacker unpacker(received); !unpacker.is_at_end();) {
            const auto vertex = unpacker.get<std::int64_t>() - bounds.vertices[talk.rank()];
            for (int c = 0; c < 3; ++c)
                slice.vertices(vertex, c) = unpacker.get<double>();
        }
}

}  // namespace seamflow
