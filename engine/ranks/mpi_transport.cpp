#include <algorithm>
#include <array>
#include <mutex>
#include <thread>
#include <utility>

#include <mpi.h>
#include <sched.h>

#include "engine/ranks/transport.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// Added to the tag of a message for all its pieces except the last.
constexpr int more_follows = 256;

/// Allows this thread, and threads that it starts, all cores that the ranks on this machine may use. mpirun binds each
/// rank to a core of its own, but rank 0 works alone with as many threads as there are ranks, and a rank receives
/// messages beside its work.
void share_cores(MPI_Comm world)
{
    MPI_Comm of_machine = MPI_COMM_NULL;
    ::MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &of_machine);
    cpu_set_t cores;
    CPU_ZERO(&cores);
    if (::sched_getaffinity(0, sizeof(cores), &cores) != 0)
        CPU_ZERO(&cores);
    ::MPI_Allreduce(MPI_IN_PLACE, &cores, sizeof(cores), MPI_BYTE, MPI_BOR, of_machine);
    // If the system refuses, ranks keep the cores that they have.
    if (CPU_COUNT(&cores) > 0)
        ::sched_setaffinity(0, sizeof(cores), &cores);
    ::MPI_Comm_free(&of_machine);
}

class MpiTransport final : public Transport {
  public:
    explicit MpiTransport(std::size_t largest_piece)
        : largest_piece_(largest_piece)
    {
        int is_started = 0;
        ::MPI_Initialized(&is_started);
        int level = MPI_THREAD_SINGLE;
        if (is_started == 0) {
            ::MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
            owns_ = true;
        } else {
            ::MPI_Query_thread(&level);
        }
        if (level < MPI_THREAD_SERIALIZED) {
            if (owns_)
                ::MPI_Finalize();
            throw ComputationError(
                "this MPI lets only one thread call it: it must be built with thread support (MPI_THREAD_SERIALIZED)");
        }
        // A communicator of its own, so that messages of other users of MPI in this program are not mixed with these.
        ::MPI_Comm_dup(MPI_COMM_WORLD, &world_);
        ::MPI_Comm_rank(world_, &rank_);
        ::MPI_Comm_size(world_, &size_);
        incomplete_.resize(size_);
        if (owns_)
            share_cores(world_);
    }

    ~MpiTransport() override
    {
        for (Outgoing& outgoing : outgoing_)
            ::MPI_Wait(&outgoing.request, MPI_STATUS_IGNORE);
        ::MPI_Comm_free(&world_);
        if (owns_)
            ::MPI_Finalize();
    }

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return size_; }

    [[nodiscard]] std::string host() const override
    {
        std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
        int length = 0;
        ::MPI_Get_processor_name(name.data(), &length);
        return {name.data(), static_cast<std::size_t>(length)};
    }

    void send(int to, int tag, Bytes bytes) override
    {
        const std::scoped_lock lock(mutex_);
        const auto shared = std::make_shared<const Bytes>(std::move(bytes));
        std::size_t begin = 0;
        do {
            const std::size_t size = std::min(largest_piece_, shared->size() - begin);
            const bool is_last = begin + size == shared->size();
            Outgoing& outgoing = outgoing_.emplace_back(Outgoing{shared, MPI_REQUEST_NULL});
            ::MPI_Isend(shared->data() + begin, static_cast<int>(size), MPI_BYTE, to,
                        is_last ? tag : tag + more_follows, world_, &outgoing.request);
            begin += size;
        } while (begin < shared->size());
    }

    /// Polls, less often the longer nothing arrives, because MPI cannot wait for messages and other events together.
    [[nodiscard]] std::optional<Message> fetch(std::chrono::microseconds patience) override
    {
        const auto end = std::chrono::steady_clock::now() + patience;
        for (std::chrono::microseconds pause{1};; pause = std::min(2 * pause, longest_pause)) {
            if (std::optional<Message> message = look())
                return message;
            if (std::chrono::steady_clock::now() >= end)
                return std::nullopt;
            std::this_thread::sleep_for(pause);
        }
    }

  private:
    static constexpr std::chrono::microseconds longest_pause{200};

    /// Bytes that MPI reads until the request is complete.
    struct Outgoing {
        std::shared_ptr<const Bytes> bytes;
        MPI_Request request;
    };

    /// Receives available pieces until a message is complete, and frees the bytes that have been sent.
    /// @returns the message; empty if no message is complete yet.
    std::optional<Message> look()
    {
        const std::scoped_lock lock(mutex_);
        std::erase_if(outgoing_, [](Outgoing& outgoing) {
            int is_complete = 0;
            ::MPI_Test(&outgoing.request, &is_complete, MPI_STATUS_IGNORE);
            return is_complete != 0;
        });
        for (;;) {
            int is_there = piece_ != MPI_MESSAGE_NULL ? 1 : 0;
            if (is_there == 0)
                ::MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, world_, &is_there, &piece_, &status_);
            if (is_there == 0)
                return std::nullopt;
            int size = 0;
            ::MPI_Get_count(&status_, MPI_BYTE, &size);
            Bytes& bytes = incomplete_[status_.MPI_SOURCE];
            const std::size_t begin = bytes.size();
            // If memory is lacking, the piece is not received yet, and stays available.
            bytes.resize(begin + static_cast<std::size_t>(size));
            ::MPI_Mrecv(bytes.data() + begin, size, MPI_BYTE, &piece_, MPI_STATUS_IGNORE);
            if (status_.MPI_TAG < more_follows)
                return Message{status_.MPI_SOURCE, status_.MPI_TAG, std::exchange(bytes, Bytes())};
        }
    }

    std::size_t largest_piece_;
    /// Whether this has started MPI, and ends it.
    bool owns_ = false;
    MPI_Comm world_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 1;
    /// Allows one thread at a time to call MPI.
    std::mutex mutex_;
    std::vector<Outgoing> outgoing_;
    /// A piece that has been found, but not yet received.
    MPI_Message piece_ = MPI_MESSAGE_NULL;
    MPI_Status status_{};
    /// Per rank, the pieces of its message that have arrived.
    std::vector<Bytes> incomplete_;
};

}  // namespace

std::unique_ptr<Transport> make_mpi_transport(std::size_t largest_piece)
{
    return std::make_unique<MpiTransport>(largest_piece);
}

}  // namespace seamflow
