#include "engine/workers.h"

#include <optional>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include "engine/single_threaded_libraries.h"

namespace seamflow {

namespace {

namespace tbb = oneapi::tbb;

/// Silences OpenMP in every thread that enters an arena, and restores it when the thread leaves.
class OpenMpSilencer final : public tbb::task_scheduler_observer {
  public:
    explicit OpenMpSilencer(tbb::task_arena& arena)
        : task_scheduler_observer(arena)
    {
        observe(true);
    }

    ~OpenMpSilencer() override { observe(false); }

    void on_scheduler_entry(bool) override { levels_before().push_back(forbid_openmp_threads()); }

    void on_scheduler_exit(bool) override
    {
        if (levels_before().empty())
            return;
        restore_openmp_threads(levels_before().back());
        levels_before().pop_back();
    }

  private:
    /// What the thread goes back to; one entry for each arena that it is in.
    static std::vector<int>& levels_before()
    {
        thread_local std::vector<int> levels;
        return levels;
    }
};

}  // namespace

class Workers::Arena {
  public:
    explicit Arena(int threads)
    {
        if (threads > 0) {
            // TBB starts no more threads than there are cores, whatever an arena asks for, unless it is told to.
            const auto wanted = static_cast<std::size_t>(threads);
            if (wanted > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
                limit.emplace(tbb::global_control::max_allowed_parallelism, wanted);
            arena.initialize(threads);
        } else {
            arena.initialize(tbb::task_arena::attach());
        }
        silencer.emplace(arena);
    }

    std::optional<tbb::global_control> limit;
    tbb::task_arena arena;
    SingleThreadedBlas single_threaded_blas;
    std::optional<OpenMpSilencer> silencer;
};

Workers::Workers(int threads)
    : arena_(std::make_unique<Arena>(threads))
{
}

Workers::~Workers() = default;

void Workers::execute(const std::function<void()>& work)
{
    arena_->arena.execute(work);
}

int Workers::threads() const
{
    return arena_->arena.max_concurrency();
}

}  // namespace seamflow
