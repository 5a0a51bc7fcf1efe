#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seamflow {

using Bytes = std::vector<std::byte>;

/// What one rank sends to another.
struct Message {
    /// The rank that has sent it.
    int from = -1;
    /// Its kind: 0 to 255.
    int tag = 0;
    Bytes bytes;
};

/// One of the ranks that work on a mesh together, each with its own memory: MPI processes, or threads of one process.
/// What is sent here is all that a rank learns of the others.
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

    /// Sends bytes without waiting until they arrive. May be called by any thread. What one rank sends to another
    /// arrives in the order in which it was sent.
    /// @param to another rank.
    virtual void send(int to, int tag, Bytes bytes) = 0;

    /// The next message, from any rank; empty if none arrives in time. One thread at a time may call it.
    [[nodiscard]] std::optional<Message> receive(std::chrono::microseconds patience)
    {
        if (put_back_.empty())
            return fetch(patience);
        Message message = std::move(put_back_.front());
        put_back_.pop_front();
        return message;
    }

    /// Puts messages that came too early before all later ones; all, or none if it throws.
    void put_back(const std::vector<Message>& messages)
    {
        std::deque<Message> all(messages.begin(), messages.end());
        all.insert(all.end(), put_back_.begin(), put_back_.end());
        put_back_.swap(all);
    }

  private:
    /// As receive, for messages not yet received.
    [[nodiscard]] virtual std::optional<Message> fetch(std::chrono::microseconds patience) = 0;

    std::deque<Message> put_back_;
};

}  // namespace seamflow
