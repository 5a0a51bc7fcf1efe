#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/polygon_mesh.h"

/// Which elements of a mesh each rank has, and how they move when that changes. Bounds are #ranks + 1: the first
/// element of each rank and, at the end, the total number. All ranks call these functions together.
namespace seamflow {

/// Bounds if each rank, in order, has n_own elements.
std::vector<std::int64_t> gather_bounds_of(Communicator& comm, std::int64_t n_own);

/// See begin_of_range.
std::vector<std::int64_t> bounds_of_ranges(std::int64_t n, int n_ranks, std::int64_t block);

/// Gives elements to the ranks that are to have them.
/// @param from, to bounds: which this rank has, and which it is to have.
/// @param pack called with the begin and the end of some elements that go to the same rank, numbered from 0 among those
///        of this rank.
/// @returns what comes from each rank; empty if nothing does.
std::vector<Bytes> move_elements(Communicator& comm, const std::vector<std::int64_t>& from,
                                 const std::vector<std::int64_t>& to,
                                 const std::function<Bytes(Index begin, Index end)>& pack);

/// The same of values.
/// @param own those of this rank by the bounds `from`. @returns those of this rank by the bounds `to`.
template <class Value>
std::vector<Value> move_values(Communicator& comm, const std::vector<Value>& own, const std::vector<std::int64_t>& from,
                               const std::vector<std::int64_t>& to)
{
    const auto pack = [&](Index begin, Index end) {
        Packer packer;
        packer.put_all(std::span<const Value>(own).subspan(at(begin), at(end - begin)));
        return packer.take();
    };
    std::vector<Value> values;
    for (const Bytes& bytes : move_elements(comm, from, to, pack))
        if (!bytes.empty())
            Unpacker(bytes).append_all(values);
    return values;
}

/// Gives rows to the ranks that are to have them.
/// @param own those of this rank by the bounds `from`. @returns those of this rank by the bounds `to`.
Points move_rows(Communicator& comm, const Points& own, const std::vector<std::int64_t>& from,
                 const std::vector<std::int64_t>& to);

/// Converts what ranks found in slices of a file to ranges as SharedMeshFile::read gives them.
/// @param found without labels; its corners are numbered in the whole mesh.
RankSlice move_to_ranges(Communicator& comm, RankSlice found, Index block);

/// The same as a mesh, with corners numbered in the whole mesh.
PolygonMesh mesh_of(const RankSlice& slice);

}  // namespace seamflow
