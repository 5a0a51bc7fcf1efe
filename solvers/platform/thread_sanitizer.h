#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#ifdef SEAMFLOW_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace seamflow {

// oneTBB is built without ThreadSanitizer, which thus sees that its threads work, but not that one waits for another,
// and would report all data handed over as races. So it is told here what oneTBB guarantees at the few places where
// work is handed to it, and no more: tasks that nothing orders stay unordered. These places, and with them the compiled
// part of oneTBB's templates, are not instrumented (see CMakeLists.txt). In other builds, all of this is empty.
#ifdef SEAMFLOW_THREAD_SANITIZER
inline constexpr bool under_thread_sanitizer = true;
/// All that this thread did until now happened before what a thread does after a later `take_over` with this token.
inline void hand_over(const void* token)
{
    __tsan_release(const_cast<void*>(token));
}
inline void take_over(const void* token)
{
    __tsan_acquire(const_cast<void*>(token));
}
#else
inline constexpr bool under_thread_sanitizer = false;
inline void hand_over(const void* /*token*/) {}
inline void take_over(const void* /*token*/) {}
#endif

/// Work that a thread hands to others and waits for, while this exists. Its parts come after the beginning and before
/// the end, mutually unordered.
class SharedWork {
  public:
    SharedWork() { hand_over(&begun_); }
    ~SharedWork() { take_over(&done_); }
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    /// Exists in the thread that does the part, while it does.
    class Part {
      public:
        explicit Part(const SharedWork& work)
            : work_(&work)
        {
            take_over(&work.begun_);
        }
        ~Part() { hand_over(&work_->done_); }
        Part(const Part&) = delete;
        Part& operator=(const Part&) = delete;

      private:
        const SharedWork* work_;
    };

  private:
    char begun_ = 0;
    char done_ = 0;
};

/// The dependencies in a graph of tasks: each comes after those that it waits for, and before the end of the run.
class TaskOrder {
  public:
    void add_dependency(std::size_t before, std::size_t after)
    {
        if constexpr (under_thread_sanitizer) {
            waiting_.resize(std::max(waiting_.size(), std::max(before, after) + 1));
            waiting_[before].push_back(after);
        }
    }

    /// Called in the thread of the task, before and after.
    void begin(std::size_t task) const
    {
        if constexpr (under_thread_sanitizer)
            if (task < waiting_.size())
                take_over(&waiting_[task]);
    }
    void end(std::size_t task) const
    {
        if constexpr (under_thread_sanitizer)
            if (task < waiting_.size())
                for (const std::size_t after : waiting_[task])
                    hand_over(&waiting_[after]);
        hand_over(this);
    }

    /// Called in the thread that releases a task that also waits for an external event.
    void come(std::size_t task) const
    {
        if constexpr (under_thread_sanitizer)
            if (task < waiting_.size())
                hand_over(&waiting_[task]);
    }

    /// Called in the thread that has waited for the run.
    void end_run() const { take_over(this); }

  private:
    /// Per task, those that wait for it. The address of its entry is its token.
    std::vector<std::vector<std::size_t>> waiting_;
};

}  // namespace seamflow
