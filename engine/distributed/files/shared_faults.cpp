#include "engine/distributed/files/shared_faults.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/distributed/parts/element_ranges.h"

namespace seamflow {

namespace {

/// The numbers of faults on one rank.
struct LogCounts {
    std::uint64_t all = 0;
    std::uint64_t harmless = 0;
};

}  // namespace

FaultLog join_faults(Communicator& comm, const FaultLog& own, Index n_faces)
{
    FaultLog joined{.of_faces_alone = own.of_faces_alone};
    const auto faces = gather_bounds_of(comm, n_faces);
    std::vector<LogCounts> counts = comm.gather_all(std::vector<LogCounts>{{own.count, own.n_harmless}});
    std::vector<Index> left_out = own.faces_left_out;
    for (Index& face : left_out)
        face += static_cast<Index>(faces[comm.rank()]);
    left_out = comm.gather_at_first(left_out);
    std::vector<char> text;
    std::vector<std::size_t> lengths;
    for (const std::string& message : own.messages) {
        text.insert(text.end(), message.begin(), message.end());
        lengths.push_back(message.size());
    }
    text = comm.gather_at_first(text);
    lengths = comm.gather_at_first(lengths);
    if (comm.rank() > 0)
        return joined;
    std::size_t begin = 0;
    for (const std::size_t length : lengths) {
        joined.add(std::string(text.data() + begin, length));
        begin += length;
    }
    joined.count = 0;
    for (const LogCounts& of_rank : counts) {
        joined.count += of_rank.all;
        joined.n_harmless += of_rank.harmless;
    }
    joined.faces_left_out = std::move(left_out);
    return joined;
}

}  // namespace seamflow
