#include "engine/tasks/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <latch>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>
#include <pthread.h>

#include "engine/options/flow_options.h"
#include "engine/options/valid_options.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/separate_cores.h"
#include "partition/errors.h"
#include "solvers/platform/address_space.h"
#include "solvers/platform/library_threads.h"
#include "solvers/platform/thread_sanitizer.h"

namespace seamflow {

namespace tbb = oneapi::tbb;

namespace {

/// Upper bound in bytes on what oneTBB's threads allocate before they look for work.
constexpr std::size_t memory_of_new_thread = 128 * 1024;

/// Creates that many threads with stacks like oneTBB's and the memory that those begin with, and ends them.
/// @returns whether the system allows it.
bool can_make_threads(int n)
{
    struct Trial {
        std::latch all_made{1};
        std::latch all_tried;
        std::atomic<bool> has_failed = false;
        explicit Trial(int threads)
            : all_tried(threads)
        {
        }
    };
    std::vector<pthread_t> threads(static_cast<std::size_t>(n));
    Trial trial(n);
    const auto try_memory = [](void* argument) -> void* {
        auto& own_trial = *static_cast<Trial*>(argument);
        own_trial.all_made.wait();
        void* const memory = std::malloc(memory_of_new_thread);
        if (memory != nullptr)
            *static_cast<volatile char*>(memory) = 0;  // so that no compiler leaves it out
        else
            own_trial.has_failed = true;
        own_trial.all_tried.arrive_and_wait();
        std::free(memory);
        return nullptr;
    };
    pthread_attr_t attributes;
    int error = ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, tbb::global_control::active_value(tbb::global_control::thread_stack_size));
    std::size_t n_made = 0;
    while (error == 0 && n_made < threads.size())
        if (error = ::pthread_create(&threads[n_made], &attributes, try_memory, &trial); error == 0)
            ++n_made;
    trial.all_tried.count_down(static_cast<std::ptrdiff_t>(threads.size() - n_made));
    trial.all_made.count_down();
    for (std::size_t i = 0; i < n_made; ++i)
        ::pthread_join(threads[i], nullptr);
    ::pthread_attr_destroy(&attributes);
    return error == 0 && !trial.has_failed;
}

/// An arena that is attached to the caller's may report more threads than the caller's limit.
int threads_of(const tbb::task_arena& arena)
{
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::min(arena.max_concurrency(), static_cast<int>(allowed));
}

/// Waits for those threads of an arena that start soon.
void bring_up_threads(tbb::task_arena& arena)
{
    const int n = threads_of(arena);
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    std::atomic<int> n_here = 0;
    const auto wait_for_all = [&](int) {
        ++n_here;
        while (n_here < n && std::chrono::steady_clock::now() < end)
            std::this_thread::yield();
    };
    // Isolated, so that the caller's own tasks are not taken up in the meantime.
    arena.execute([&] {
        tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, n, wait_for_all, tbb::simple_partitioner()); });
    });
}

/// oneTBB ends the program if the system refuses it a thread, or memory for what a thread begins with, as it does if
/// the address space is limited and full. To avoid that, threads are made here first, and then oneTBB's at once. The C
/// library keeps the memory of the stacks for them, for about the first nine (40 MiB).
/// @throws ComputationError if there is no room for them.
void require_room_for_threads(tbb::task_arena& arena)
{
    const int n = threads_of(arena) - 1;
    static std::mutex mutex;
    // oneTBB keeps its threads.
    static int most_made = 0;
    if (!limit_of_address_space())
        return;
    {
        const std::lock_guard lock(mutex);
        if (n <= most_made)
            return;
        if (!can_make_threads(n))
            throw ComputationError(
                fmt::format("there is no memory for {} more threads: use fewer (--threads), or raise "
                            "the limit of this program (ulimit -v)",
                            n));
        most_made = n;
    }
    bring_up_threads(arena);
}

/// Tells SeparateCores which threads enter and leave an arena, which must outlive this.
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
        require_threads(threads);
        if (threads > 0) {
            // TBB starts no more threads than there are cores, whatever an arena asks for, unless told otherwise.
            const auto wanted = static_cast<std::size_t>(threads);
            if (wanted > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
                limit.emplace(tbb::global_control::max_allowed_parallelism, wanted);
            // The lowest limit applies, the program's own included; TBB complains about arenas that ask for more.
            const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
            arena.initialize(static_cast<int>(std::min(wanted, allowed)));
        } else {
            arena.initialize(tbb::task_arena::attach());
        }
        require_room_for_threads(arena);
        if (threads_of(arena) > 1)
            threads_of_arena = std::make_unique<ThreadsOfArena>(arena);
    }

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
