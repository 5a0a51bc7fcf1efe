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

/// How the work of a rank has ended.
struct WorkOutcome {
    enum class Kind : std::uint8_t {
        Done,
        /// Another rank has failed.
        Interrupted,
        /// It has thrown an error of errors.h.
        InputError,
        OptionError,
        ComputationError,
        OutputError,
        Cancelled,
        OutOfMemory,
        /// Anything else.
        Failure,
    };
    Kind kind = Kind::Done;
    std::string message = {};
    /// The machine.
    std::string host = {};
};

/// Does what other ranks wait for, retrying while memory is lacking: what a failing rank had is freed meanwhile.
/// @throws what the action throws, std::bad_alloc after some seconds.
template <class Action>
void retry(Action&& action)
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
/// within `run`. All of them, and next_arrival, throw if another rank fails in the meantime.
class Communicator {
  public:
    /// @param transport must outlive this.
    explicit Communicator(Transport& transport);

    [[nodiscard]] int rank() const { return transport_->rank(); }
    [[nodiscard]] int size() const { return transport_->size(); }

    /// Runs `work` on this rank, as every rank does, and waits until all ranks are at its end. If it throws on one
    /// rank, it ends on all of them, as soon as each waits for another: then all throw what the lowest rank that failed
    /// by itself has thrown, with the number and the machine of that rank before it, except if all have failed alike.
    /// What may fail on one rank alone belongs in `work`.
    /// @throws the errors of errors.h as they are; std::bad_alloc and all others as ComputationError.
    template <class Work>
    void run(Work&& work)
    {
        // By reference, which takes no memory: without any, others would wait for this rank.
        run_work(std::ref(work));
    }

    /// Sends something to another rank, which takes it, in order.
    void give(int to, Bytes bytes);
    Bytes take(int from);

    /// What every rank gives, in the order of ranks.
    std::vector<Bytes> allgather(Bytes own);

    /// The same for a list of values each, joined.
    template <class Value>
    std::vector<Value> gather_all(const std::vector<Value>& own)
    {
        std::vector<Value> all;
        for (const Bytes& bytes : allgather(packed(own)))
            Unpacker(bytes).append_all(all);
        return all;
    }

    /// Sends bytes to some other ranks, and receives those for this one.
    /// @param others ascending; each of them names this rank. @param to_each corresponds. @returns the same.
    std::vector<Bytes> exchange(std::span<const int> others, std::vector<Bytes> to_each);

    /// Sends something that no collective function waits for. Any thread may do so, at any time.
    /// @param to another rank.
    void send(int to, Bytes bytes);

    /// The next of these to arrive; empty if none does in time.
    std::optional<Message> next_arrival(std::chrono::microseconds patience);

    /// What has been sent so far, collective functions included.
    [[nodiscard]] std::uint64_t n_messages() const { return n_messages_; }
    [[nodiscard]] std::uint64_t n_bytes() const { return n_bytes_; }

  private:
    void run_work(const std::function<void()>& work);
    /// Tells all ranks how the work has ended here, and waits until all have done so.
    std::vector<WorkOutcome> part(const WorkOutcome& own);
    bool take_in(std::chrono::microseconds patience);
    void sort_in(Message message);
    void require_all_well() const;
    void send(int to, int tag, Bytes bytes);

    Transport* transport_;
    /// Per rank, what has arrived for collective functions, in order.
    std::vector<std::deque<Bytes>> collective_;
    /// A list takes no memory while it is empty: others would wait for a rank that has none to begin with.
    std::list<Message> arrivals_;
    /// Per rank; empty: still at work.
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
