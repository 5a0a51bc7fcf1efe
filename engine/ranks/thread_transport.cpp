#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/ranks/transport.h"

namespace seamflow {

namespace {

/// The messages that have arrived at a rank.
class Inbox {
  public:
    void put(Message message)
    {
        {
            const std::scoped_lock lock(mutex_);
            messages_.push_back(std::move(message));
        }
        arrived_.notify_one();
    }

    /// The first message; empty if none arrives in time.
    std::optional<Message> take(std::chrono::microseconds patience)
    {
        std::unique_lock lock(mutex_);
        if (!arrived_.wait_for(lock, patience, [&] { return !messages_.empty(); }))
            return std::nullopt;
        Message message = std::move(messages_.front());
        messages_.pop_front();
        return message;
    }

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<Message> messages_;
};

class ThreadTransport final : public Transport {
  public:
    ThreadTransport(int rank, std::vector<Inbox>& inboxes)
        : rank_(rank)
        , inboxes_(&inboxes)
    {
    }

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return static_cast<int>(inboxes_->size()); }
    [[nodiscard]] std::string host() const override { return "this process"; }

    void send(int to, int tag, Bytes bytes) override { (*inboxes_)[to].put({rank_, tag, std::move(bytes)}); }

    [[nodiscard]] std::optional<Message> fetch(std::chrono::microseconds patience) override
    {
        return (*inboxes_)[rank_].take(patience);
    }

  private:
    int rank_;
    std::vector<Inbox>* inboxes_;
};

}  // namespace

void run_on_threads(int n, const std::function<void(Transport&)>& body)
{
    std::vector<Inbox> inboxes(n);
    std::deque<ThreadTransport> transports;
    for (int rank = 0; rank < n; ++rank)
        transports.emplace_back(rank, inboxes);
    std::vector<std::exception_ptr> failures(n);
    // No rank begins before the threads of all ranks exist: it could wait for a rank that never starts.
    std::promise<bool> all_begin;
    const std::shared_future<bool> begin = all_begin.get_future().share();
    std::vector<std::jthread> threads;
    try {
        for (int rank = 0; rank < n; ++rank)
            threads.emplace_back([&, rank] {
                if (!begin.get())
                    return;
                try {
                    body(transports[rank]);
                } catch (...) {
                    failures[rank] = std::current_exception();
                }
            });
    } catch (...) {
        all_begin.set_value(false);
        throw;
    }
    all_begin.set_value(true);
    threads.clear();
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

}  // namespace seamflow
