#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "engine/options/flow_control.h"

namespace seamflow {

/// Work in its own thread, so that the thread of Python can check for signals, which reach no other thread.
template <class Result>
class WorkThread {
  public:
    /// @param work which the control stops and observes, without anything of Python.
    WorkThread(std::function<Result(const FlowControl&)> work, bool tells_progress)
    {
        FlowControl control{.stop = stop_.get_token()};
        if (tells_progress)
            control.on_progress = [this](const FlowProgress& progress) {
                const std::lock_guard lock(mutex_);
                heard_.push_back(progress);
                changed_.notify_one();
            };
        thread_ = std::jthread([this, work = std::move(work), control] {
            try {
                result_ = work(control);
            } catch (...) {
                failure_ = std::current_exception();
            }
            const std::lock_guard lock(mutex_);
            is_over_ = true;
            changed_.notify_one();
        });
    }

    void stop() { stop_.request_stop(); }

    /// Waits until there is something to report, a moment has passed, or the work has ended.
    /// @returns whether it has ended.
    bool wait(std::vector<FlowProgress>& heard)
    {
        constexpr std::chrono::milliseconds moment(50);
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, moment, [this] { return is_over_ || !heard_.empty(); });
        heard.clear();
        heard.swap(heard_);
        return is_over_;
    }

    /// To be called when it has ended. @throws what it threw.
    Result take()
    {
        if (failure_)
            std::rethrow_exception(failure_);
        return std::move(result_);
    }

  private:
    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<FlowProgress> heard_;
    bool is_over_ = false;
    Result result_;
    std::exception_ptr failure_;
    std::jthread thread_;
};

}  // namespace seamflow
