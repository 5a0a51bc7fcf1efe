#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#ifdef SEAMFLOW_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace seamflow {

// oneTBB is built without ThreadSanitizer, which therefore sees that oneTBB's threads work, but not that one waits for
// another, and would report all data handed over as races. The following functions tell ThreadSanitizer what oneTBB
// guarantees where work is handed to it, and no more: tasks that nothing orders stay unordered. These functions, and
// the compiled part of oneTBB's templates, are not instrumented (see CMakeLists.txt). In other builds, all of them are
// empty.
#ifdef SEAMFLOW_THREAD_SANITIZER
inline constexpr bool under_thread_sanitizer = true;
/// Declares that all work of this thread until now happens before the work of a thread after a later `take_over` with
/// the same token.
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

/// Work that a thread hands to other threads and waits for, while this object exists. Its parts happen after the
/// beginning and before the end, mutually unordered.
class SharedWork {
  public:
    SharedWork() { hand_over(&begun_); }
    ~SharedWork() { take_over(&done_); }
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    /// Exists in the thread that does a part of the work, while that thread does it.
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

/// The dependencies in a graph of tasks: each task happens after the tasks that it waits for, and before the end of the
/// run.
class TaskOrder {
  public:
    void add_dependency(std::size_t before, std::size_t after)
    {
        if constexpr (under_thread_sanitizer) {
            waiting_.resize(std::max(waiting_.size(), std::max(before, after) + 1));
            waiting_[before].push_back(after);
        }
    }

    /// To be called in the thread of the task, before it and after it.
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

    /// To be called in the thread that signals the event for which a task waits.
    void come(std::size_t task) const
    {
        if constexpr (under_thread_sanitizer)
            if (task < waiting_.size())
                hand_over(&waiting_[task]);
    }

    /// To be called in the thread that has waited for the run.
    void end_run() const { take_over(this); }

  private:
    /// Per task, the tasks that wait for it. The address of an entry is the token of its task.
    std::vector<std::vector<std::size_t>> waiting_;
};

}  // namespace seamflow
