#include "engine/tasks/workers.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include "engine/options/option_limits.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/separate_cores.h"
#include "solvers/platform/library_threads.h"
#include "solvers/platform/thread_sanitizer.h"

namespace seamflow {

namespace tbb = oneapi::tbb;

namespace {

/// The number of threads of an arena, at most the program's limit: an arena that is attached to the caller's may report
/// more.
int threads_of(const tbb::task_arena& arena)
{
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::min(arena.max_concurrency(), static_cast<int>(allowed));
}

/// Keeps the threads of an arena on separate cores (see SeparateCores) as they enter and leave it.
class ThreadsOfArena final : public tbb::task_scheduler_observer {
  public:
    explicit ThreadsOfArena(tbb::task_arena& arena)
        : tbb::task_scheduler_observer(arena)
        , cores_(threads_of(arena))
    {
        observe(true);
    }
    ~ThreadsOfArena() override { observe(false); }
    ThreadsOfArena(const ThreadsOfArena&) = delete;
    ThreadsOfArena& operator=(const ThreadsOfArena&) = delete;

  private:
    void on_scheduler_entry(bool /*is_worker*/) override { cores_.enter(tbb::this_task_arena::current_thread_index()); }
    void on_scheduler_exit(bool /*is_worker*/) override { cores_.leave(tbb::this_task_arena::current_thread_index()); }

    SeparateCores cores_;
};

}  // namespace

class Workers::Arena {
  public:
    explicit Arena(int threads)
    {
        require_within({.field = "threads", .limits = limits_of_threads}, threads);
        if (threads > 0) {
            // TBB starts no more threads than there are cores, whatever an arena asks for, unless the limit is raised.
            const auto asked_for = static_cast<std::size_t>(threads);
            if (asked_for > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
                limit.emplace(tbb::global_control::max_allowed_parallelism, asked_for);
            // The lowest limit applies, including that of the program; TBB prints warnings about arenas that ask for
            // more.
            const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
            arena.initialize(static_cast<int>(std::min(asked_for, allowed)));
        } else {
            arena.initialize(tbb::task_arena::attach());
        }
        if (threads_of(arena) > 1)
            threads_of_arena = std::make_unique<ThreadsOfArena>(arena);
    }

    /// Raises oneTBB's limit if more threads are wanted than there are cores.
    std::optional<tbb::global_control> limit;
    tbb::task_arena arena;
    std::unique_ptr<tbb::task_scheduler_observer> threads_of_arena;
    SingleThreadedBlas single_threaded_blas;
};

Workers::Workers(int threads)
    : arena_(std::make_unique<Arena>(threads))
{
}

Workers::~Workers() = default;

void Workers::execute(const std::function<void()>& work)
{
    const SharedWork shared;
    arena_->arena.execute([&] {
        const SharedWork::Part part(shared);
        work();
    });
}

Executor Workers::exec()
{
    return [this](Index n, const RangeBody& body) { execute([&] { run_in_parallel(n, body); }); };
}

int Workers::threads() const
{
    return threads_of(arena_->arena);
}

}  // namespace seamflow
