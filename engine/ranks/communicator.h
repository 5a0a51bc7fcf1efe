#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <list>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "engine/ranks/packing.h"
#include "engine/ranks/transport.h"

namespace seamflow {

/// The end of the work on a rank.
struct WorkOutcome {
    enum class Kind : std::uint8_t {
        Done,
        /// It was interrupted because another rank has failed.
        Interrupted,
        /// It has thrown an error of errors.h.
        InputError,
        OptionError,
        ComputationError,
        OutputError,
        Cancelled,
        OutOfMemory,
        /// It has thrown any other exception.
        Failure,
    };
    Kind kind = Kind::Done;
    std::string message = {};
    /// The name of the rank's machine.
    std::string host = {};
};

/// Runs an action that other ranks wait for, retrying while memory is lacking: a failing rank frees memory meanwhile.
/// @returns what the action returns. @throws whatever the action throws, std::bad_alloc after some seconds.
template <class Action>
auto retry(Action&& action)
{
    constexpr int most_attempts = 500;
    constexpr std::chrono::milliseconds pause{10};
    for (int attempt = 1;; ++attempt) {
        try {
            return action();
        } catch (const std::bad_alloc&) {
            if (attempt == most_attempts)
                throw;
            std::this_thread::sleep_for(pause);
        }
    }
}

/// Communication of ranks that work together: each rank calls the collective functions in the same order as the others,
/// within `run`. All collective functions, and next_arrival, throw if another rank fails in the meantime.
class Communicator {
  public:
    /// @param transport must outlive this.
    explicit Communicator(Transport& transport);

    [[nodiscard]] int rank() const { return transport_->rank(); }
    [[nodiscard]] int size() const { return transport_->size(); }

    /// Runs `work` on this rank, as every rank does, and waits until all ranks have ended it. If the work throws on one
    /// rank, it ends on all ranks, as soon as each waits for another one. All ranks then throw the exception of the
    /// lowest rank that failed by itself. Its message begins with the number and the machine of that rank, unless all
    /// ranks have failed in the same way. Actions that can fail on one rank alone belong in `work`.
    /// @throws the errors of errors.h as they are; std::bad_alloc and all others as ComputationError.
    template <class Work>
    void run(Work&& work)
    {
        // By reference, which allocates no memory: if that failed on this rank alone, other ranks would wait for it.
        run_work(std::ref(work));
    }

    /// Sends bytes to another rank, which receives them by `take`, in the same order. `take` waits for them.
    void give(int to, Bytes bytes);
    Bytes take(int from);

    /// The bytes that every rank gives, in the order of ranks.
    std::vector<Bytes> allgather(Bytes own);

    /// The lists of values that all ranks give, joined in the order of ranks.
    template <class Value>
    std::vector<Value> gather_all(const std::vector<Value>& own)
    {
        std::vector<Value> all;
        for (const Bytes& bytes : allgather(packed(own)))
            Unpacker(bytes).append_all(all);
        return all;
    }

    /// Sends bytes to some other ranks, and receives bytes from them.
    /// @param others ascending; each of these ranks also has this rank among its `others`.
    /// @param to_each one per rank in `others`. @returns one from each rank in `others`.
    std::vector<Bytes> exchange(std::span<const int> others, std::vector<Bytes> to_each);

    /// Sends bytes for next_arrival of another rank, not for a collective function. May be called from any thread, at
    /// any time.
    /// @param to another rank.
    void send(int to, Bytes bytes);

    /// The next message that another rank has sent by `send`; empty if none arrives within the patience.
    std::optional<Message> next_arrival(std::chrono::microseconds patience);

    /// The number of messages sent so far, including those of collective functions.
    [[nodiscard]] std::uint64_t n_messages() const { return n_messages_; }
    [[nodiscard]] std::uint64_t n_bytes() const { return n_bytes_; }

  private:
    void run_work(const std::function<void()>& work);
    /// Sends all ranks the outcome of the work on this rank, and waits for the outcomes of all ranks.
    std::vector<WorkOutcome> exchange_outcomes(const WorkOutcome& own);
    bool take_in(std::chrono::microseconds patience);
    void sort_in(Message message);
    void require_all_well() const;
    void send(int to, int tag, Bytes bytes);

    Transport* transport_;
    /// Per rank, the messages that have arrived for collective functions, in order.
    std::vector<std::deque<Bytes>> collective_;
    /// The messages for next_arrival. An empty list allocates no memory: if that failed on this rank alone, other ranks
    /// would wait for it.
    std::list<Message> arrivals_;
    /// Per rank, its outcome; empty while the rank works.
    std::vector<std::optional<WorkOutcome>> ended_;
    std::atomic<std::uint64_t> n_messages_ = 0;
    std::atomic<std::uint64_t> n_bytes_ = 0;
};

/// Runs work(Communicator&) on this rank, as every rank does (see Communicator::run).
template <class Work>
void run_together(Transport& transport, Work&& work)
{
    Communicator comm(transport);
    comm.run([&] { work(comm); });
}

}  // namespace seamflow
