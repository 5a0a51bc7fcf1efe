#include "engine/distributed/rank_checkpoint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/state/checksum.h"
#include "partition/errors.h"
#include "partition/io/output_file.h"

// The list is text: the line below, the step, how many arrays there are beside positions, a line for each number, for
// each file and for each entry of the identity, and the checksum of all that. A file has the positions of a range and
// then the arrays, as doubles as the machine has them.

namespace seamflow {

namespace {

constexpr std::string_view line_of_lists = "seamflow checkpoint of ranks, format 2";
constexpr const char* list_name = "smooth-distributed.checkpoint";
constexpr const char* prefix_of_steps = "smooth-distributed.step-";

/// A file of positions and arrays.
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

std::uint64_t checksum_of_numbers(std::span<const double> numbers)
{
    Checksum checksum;
    checksum.add_numbers(numbers);
    return checksum.value();
}

[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& what)
{
    throw InputError(fmt::format("{}: {}; remove it to begin anew", file.string(), what));
}

std::string text_of_list(const RankList& list)
{
    std::string text = fmt::format("{}\nstep {}\narrays {}\n", line_of_lists, list.step, list.n_arrays);
    for (const double number : list.numbers)
        text += fmt::format("number {:x}\n", std::bit_cast<std::uint64_t>(number));
    for (const KeptRange& one : list.ranges)
        text += fmt::format("file {} {} {}\n", one.begin, one.n_vertices, one.checksum);
    for (const FlowIdentity::Entry& entry : list.identity.entries)
        text += fmt::format("option {} {}\n", entry.name, entry.value);
    return text + fmt::format("end {}\n", XXH3_64bits(text.data(), text.size()));
}

/// @throws InputError for a file that is none, or not as it was written.
RankList read_rank_list(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream || !text.starts_with(line_of_lists))
        refuse_file(file, "is no list of a checkpoint of ranks that this version can read");
    RankList list;
    std::istringstream lines(text.substr(line_of_lists.size() + 1));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (name == "step") {
            words >> list.step;
        } else if (name == "arrays") {
            words >> list.n_arrays;
        } else if (name == "number") {
            std::uint64_t bits = 0;
            words >> std::hex >> bits;
            list.numbers.push_back(std::bit_cast<double>(bits));
        } else if (name == "file") {
            KeptRange& one = list.ranges.emplace_back();
            words >> one.begin >> one.n_vertices >> one.checksum;
        } else if (name == "option") {
            FlowIdentity::Entry& entry = list.identity.entries.emplace_back();
            words >> entry.name;
            std::getline(words >> std::ws, entry.value);
        }
    }
    if (text_of_list(list) != text)
        refuse_file(file, "has been changed since it was written, or is cut off");
    return list;
}

/// @throws InputError unless the file is as it was written.
std::vector<double> read_range(const std::filesystem::path& file, const KeptRange& range, std::int64_t n_arrays)
{
    std::error_code error;
    const std::uintmax_t n_bytes = std::filesystem::file_size(file, error);
    const auto n = static_cast<std::size_t>(range.n_vertices * 3 * (1 + n_arrays));
    if (error || n_bytes != n * sizeof(double))
        refuse_file(file, "is missing, or has not the length that the list of the checkpoint says");
    std::vector<double> numbers(n);
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(n_bytes));
    if (!stream || checksum_of_numbers(numbers) != range.checksum)
        refuse_file(file, "has been changed since it was written");
    return numbers;
}

void require_belongs(const RankList& list, const FlowIdentity& identity, int steps, const std::filesystem::path& file)
{
    const auto message = [&](const std::exception& error) {
        return file.string() + ": " + error.what() +
               "; go on with the same input and options, name another folder, or remove it to begin anew";
    };
    try {
        require_same(list.identity, identity);
        if (list.step > steps)
            throw OptionError(fmt::format("is after step {}, but steps is {}", list.step, steps));
    } catch (const InputError& error) {
        throw InputError(message(error));
    } catch (const OptionError& error) {
        throw OptionError(message(error));
    }
}

/// Sums do not depend on who adds what.
std::uint64_t sum_of_all(Communicator& comm, std::uint64_t own)
{
    std::uint64_t sum = 0;
    for (const std::uint64_t of_rank : comm.gather_all(std::vector<std::uint64_t>{own}))
        sum += of_rank;
    return sum;
}

/// Of values that stand at a place.
std::uint64_t hash_at(std::int64_t place, std::span<const std::byte> values)
{
    return XXH3_64bits_withSeed(values.data(), values.size(), static_cast<std::uint64_t>(place));
}

/// Entries of other steps, which no list names any more.
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

/// The positions first. @param state a RankFlowState, const or not.
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
    return sum_of_all(comm, own);
}

std::uint64_t checksum_of_labels(Communicator& comm, const RankSlice& slice)
{
    const std::int64_t begin = gather_bounds(comm, slice).faces[comm.rank()];
    std::uint64_t own = 0;
    for (std::size_t f = 0; f < slice.labels.size(); ++f)
        own += hash_at(begin + static_cast<std::int64_t>(f), std::as_bytes(std::span(&slice.labels[f], 1)));
    return sum_of_all(comm, own);
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
        std::error_code error;
        std::filesystem::create_directories(folder_, error);
        if (!std::filesystem::is_directory(folder_))
            throw OutputError(folder_.string() + ": there can be no such folder for checkpoints; name another");
        if (!std::filesystem::exists(file()))
            return;
        list = read_rank_list(file());
        require_belongs(list, identity_, steps, file());
        std::int64_t n = 0;
        for (const KeptRange& one : list.ranges)
            n += one.begin == n ? one.n_vertices : 0;
        if (n != bounds.back())
            refuse_file(file(), "does not list positions of all vertices");
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
            const std::vector<double> numbers = read_range(file_of(state.step, i), one, counts[1]);
            const double* next = numbers.data() + 3 * (from - one.begin);
            for (Points* const array : arrays_of(state)) {
                std::copy_n(next, 3 * (to - from), array->data() + 3 * (from - begin));
                next += 3 * one.n_vertices;
            }
        }
    });
    return state;
}

void RankCheckpoint::keep(Communicator& comm, const RankFlowState& state) const
{
    std::vector<double> numbers;
    numbers.reserve(static_cast<std::size_t>(state.vertices.size()) * (1 + state.arrays.size()));
    for (const Points* const array : arrays_of(state))
        numbers.insert(numbers.end(), array->data(), array->data() + array->size());
    OutputFile file_here(file_of(state.step, static_cast<std::size_t>(comm.rank())));
    file_here.text({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)});
    file_here.commit();
    const KeptRange own{.begin = 0, .n_vertices = state.vertices.rows(), .checksum = checksum_of_numbers(numbers)};
    // When rank 0 has them all files are on the disk.
    RankList list{.step = state.step,
                  .n_arrays = std::ssize(state.arrays),
                  .numbers = state.numbers,
                  .ranges = comm.gather_at_first(std::vector<KeptRange>{own}),
                  .identity = identity_};
    comm.at_first_rank([&] {
        std::int64_t n = 0;
        for (KeptRange& one : list.ranges)
            n = (one.begin = n) + one.n_vertices;
        OutputFile file_of_list(file());
        file_of_list.text(text_of_list(list));
        file_of_list.commit();
        remove_others(folder_, name_of_step(state.step));
    });
}

}  // namespace seamflow
