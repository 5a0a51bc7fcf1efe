#include "engine/distributed/rank_checkpoint.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/state/archive.h"
#include "engine/state/checkpoint.h"

namespace seamflow {

namespace {

constexpr std::string_view line_of_lists = "seamflow checkpoint of ranks\n";
constexpr std::string_view line_of_ranges = "seamflow range of a rank\n";
constexpr const char* list_name = "smooth-distributed.checkpoint";
constexpr const char* prefix_of_steps = "smooth-distributed.step-";

/// A file with the share of a rank.
struct KeptRange {
    std::int64_t begin = 0;
    std::int64_t n_vertices = 0;
    std::uint64_t checksum = 0;
};

struct RankList {
    std::int64_t step = 0;
    std::int64_t n_arrays = 0;
    std::vector<double> numbers;
    std::vector<KeptRange> ranges;
    FlowIdentity identity;
};

auto fields(Is<KeptRange> auto& of)
{
    auto& [begin, n_vertices, checksum] = of;
    return std::tie(begin, n_vertices, checksum);
}

auto fields(Is<RankList> auto& of)
{
    auto& [step, n_arrays, numbers, ranges, identity] = of;
    return std::tie(step, n_arrays, numbers, ranges, identity);
}

/// The sum does not depend on who adds what.
std::uint64_t sum_over_ranks(Communicator& comm, std::uint64_t own)
{
    std::uint64_t sum = 0;
    for (const std::uint64_t of_rank : comm.gather_all(std::vector<std::uint64_t>{own}))
        sum += of_rank;
    return sum;
}

/// The hash of values at a place.
std::uint64_t hash_at(std::int64_t place, std::span<const std::byte> values)
{
    return XXH3_64bits_withSeed(values.data(), values.size(), static_cast<std::uint64_t>(place));
}

/// Removes files of other steps, which no list names any more.
void remove_others(const std::filesystem::path& folder, const std::string& kept)
{
    std::error_code ignored;
    std::vector<std::filesystem::path> others;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (const std::string name = entry.path().filename().string();
            name.starts_with(prefix_of_steps) && !name.starts_with(kept))
            others.push_back(entry.path());
    for (const auto& path : others)
        std::filesystem::remove(path, ignored);
}

/// Positions come first. @param state a RankFlowState, const or not.
auto arrays_of(auto& state)
{
    std::vector arrays{&state.vertices};
    for (auto& array : state.arrays)
        arrays.push_back(&array);
    return arrays;
}

std::string name_of_step(int step)
{
    return fmt::format("{}{}.", prefix_of_steps, step);
}

}  // namespace

auto fields(Is<RankFlowState> auto& of)
{
    auto& [step, vertices, arrays, numbers] = of;
    return std::tie(step, vertices, arrays, numbers);
}

std::uint64_t checksum_of_mesh(Communicator& comm, const RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(comm, slice);
    std::uint64_t own = 0;
    for (Eigen::Index v = 0; v < slice.vertices.rows(); ++v) {
        const std::array position{slice.vertices(v, 0), slice.vertices(v, 1), slice.vertices(v, 2)};
        own += hash_at(bounds.vertices[comm.rank()] + v, std::as_bytes(std::span(position)));
    }
    for (Index f = 0; f < slice.n_faces(); ++f) {
        const Index begin = slice.face_offsets[f];
        const std::span corners(slice.corners.data() + begin,
                                static_cast<std::size_t>(slice.face_offsets[f + 1] - begin));
        own += hash_at(~(bounds.faces[comm.rank()] + f), std::as_bytes(corners));
    }
    return sum_over_ranks(comm, own);
}

std::uint64_t checksum_of_labels(Communicator& comm, const RankSlice& slice)
{
    const std::int64_t begin = gather_bounds(comm, slice).faces[comm.rank()];
    std::uint64_t own = 0;
    for (std::size_t f = 0; f < slice.labels.size(); ++f)
        own += hash_at(begin + static_cast<std::int64_t>(f), std::as_bytes(std::span(&slice.labels[f], 1)));
    return sum_over_ranks(comm, own);
}

RankCheckpoint::RankCheckpoint(std::filesystem::path folder, FlowIdentity identity)
    : folder_(std::move(folder))
    , identity_(std::move(identity))
{
}

std::filesystem::path RankCheckpoint::file() const
{
    return folder_ / list_name;
}

std::filesystem::path RankCheckpoint::file_of(int step, std::size_t rank) const
{
    return folder_ / (name_of_step(step) + fmt::format("{}", rank));
}

std::optional<RankFlowState> RankCheckpoint::find(Communicator& comm, std::span<const std::int64_t> bounds,
                                                  int steps) const
{
    RankList list;
    comm.at_first_rank([&] {
        make_checkpoint_folder(folder_);
        if (!std::filesystem::exists(file()))
            return;
        list = read_archive<RankList>(file(), line_of_lists);
        require_belongs(file(), list.identity, identity_, list.step, steps);
        std::int64_t n = 0;
        for (const KeptRange& one : list.ranges)
            n += one.begin == n ? one.n_vertices : 0;
        if (n != bounds.back())
            refuse_archive(file(), "does not list the positions of all vertices");
    });
    list.ranges = comm.broadcast(list.ranges);
    if (list.ranges.empty())
        return std::nullopt;
    const auto counts = comm.broadcast(std::vector<std::int64_t>{list.step, list.n_arrays});
    RankFlowState state{.step = static_cast<int>(counts[0]), .numbers = comm.broadcast(list.numbers)};
    const std::int64_t begin = bounds[static_cast<std::size_t>(comm.rank())];
    const std::int64_t end = bounds[static_cast<std::size_t>(comm.rank()) + 1];
    state.vertices.resize(end - begin, 3);
    state.arrays.assign(static_cast<std::size_t>(counts[1]), state.vertices);
    comm.look_together([&] {
        for (std::size_t i = 0; i < list.ranges.size(); ++i) {
            const KeptRange& one = list.ranges[i];
            const std::int64_t from = std::max(begin, one.begin);
            const std::int64_t to = std::min(end, one.begin + one.n_vertices);
            if (from >= to)
                continue;
            const auto kept = read_archive<RankFlowState>(file_of(state.step, i), line_of_ranges, one.checksum);
            const auto kept_arrays = arrays_of(kept);
            if (kept_arrays.size() != arrays_of(state).size() ||
                !std::ranges::all_of(kept_arrays, [&](const Points* rows) { return rows->rows() == one.n_vertices; }))
                refuse_archive(file_of(state.step, i), "does not hold what the list of the checkpoint says");
            for (std::size_t k = 0; Points* const array : arrays_of(state))
                array->middleRows(from - begin, to - from) = kept_arrays[k++]->middleRows(from - one.begin, to - from);
        }
    });
    return state;
}

void RankCheckpoint::keep(Communicator& comm, const RankFlowState& state) const
{
    const std::uint64_t checksum =
        write_archive(file_of(state.step, static_cast<std::size_t>(comm.rank())), line_of_ranges, state);
    const KeptRange own{.begin = 0, .n_vertices = state.vertices.rows(), .checksum = checksum};
    // Once rank 0 has them, all files are on disk.
    RankList list{.step = state.step,
                  .n_arrays = std::ssize(state.arrays),
                  .numbers = state.numbers,
                  .ranges = comm.gather_at_first(std::vector<KeptRange>{own}),
                  .identity = identity_};
    comm.at_first_rank([&] {
        std::int64_t n = 0;
        for (KeptRange& one : list.ranges)
            n = (one.begin = n) + one.n_vertices;
        write_archive(file(), line_of_lists, list);
        remove_others(folder_, name_of_step(state.step));
    });
}

}  // namespace seamflow
