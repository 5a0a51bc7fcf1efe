#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seamflow {

using Bytes = std::vector<std::byte>;

/// A message from one rank to another.
struct Message {
    /// The rank that has sent it.
    int from = -1;
    /// The kind of the message: 0 to 255.
    int tag = 0;
    Bytes bytes;
};

/// One of the ranks that work on a mesh together, each with its own memory: MPI processes, or threads of one process. A
/// rank gets no data from other ranks except by its transport.
class Transport {
  public:
    Transport() = default;
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;
    virtual ~Transport() = default;

    /// The number of this rank, from 0 to size() - 1.
    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int size() const = 0;

    /// The name of the machine.
    [[nodiscard]] virtual std::string host() const = 0;

    /// Sends bytes without waiting until they arrive. May be called by any thread. Messages from one rank to another
    /// arrive in the order in which they were sent.
    /// @param to another rank.
    virtual void send(int to, int tag, Bytes bytes) = 0;

    /// The next message, from any rank; empty if none arrives within the patience. One thread at a time may call this.
    [[nodiscard]] std::optional<Message> receive(std::chrono::microseconds patience)
    {
        if (put_back_.empty())
            return fetch(patience);
        Message message = std::move(put_back_.front());
        put_back_.pop_front();
        return message;
    }

    /// Puts messages that came too early in front of all later messages; all of them, or none if it throws.
    void put_back(const std::vector<Message>& messages)
    {
        std::deque<Message> all(messages.begin(), messages.end());
        all.insert(all.end(), put_back_.begin(), put_back_.end());
        put_back_.swap(all);
    }

  private:
    /// The next message from the network: as receive, without messages that were put back.
    [[nodiscard]] virtual std::optional<Message> fetch(std::chrono::microseconds patience) = 0;

    std::deque<Message> put_back_;
};

/// The ranks of MPI_COMM_WORLD. Starts MPI if that has not been done; MPI then ends with the transport. Work with the
/// transport belongs to a RankGroup and serve_flows, so that no rank ends alone. If a process dies, MPI ends the
/// others.
/// @param largest_piece longer messages are sent in pieces of this size, as MPI counts bytes in 31 bits.
/// @throws ComputationError if MPI does not let several threads take turns (MPI_THREAD_SERIALIZED).
std::unique_ptr<Transport> make_mpi_transport(std::size_t largest_piece = std::size_t{1} << 30);

/// Runs `body` once for each of n ranks, which are threads of this process, and waits for all of them. A body that
/// throws does not end the others: use a RankGroup and serve_flows within it.
/// @param n at least 1.
/// @throws the exception of the lowest rank whose body has thrown.
void run_on_threads(int n, const std::function<void(Transport&)>& body);

}  // namespace seamflow
