#include "engine/workers.h"

#include <algorithm>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/single_threaded_libraries.h"
#include "engine/thread_order.h"

namespace seamflow {

namespace tbb = oneapi::tbb;

class Workers::Arena {
  public:
    explicit Arena(int threads)
    {
        if (threads > 0) {
            // TBB starts no more threads than there are cores, whatever an arena asks for, unless it is told to.
            const auto wanted = static_cast<std::size_t>(threads);
            if (wanted > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
                limit.emplace(tbb::global_control::max_allowed_parallelism, wanted);
            // The lowest of all limits holds, the program's own included; TBB complains of arenas that ask for more.
            const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
            arena.initialize(static_cast<int>(std::min(wanted, allowed)));
        } else {
            arena.initialize(tbb::task_arena::attach());
        }
    }

    std::optional<tbb::global_control> limit;
    tbb::task_arena arena;
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

int Workers::threads() const
{
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::min(arena_->arena.max_concurrency(), static_cast<int>(allowed));
}

}  // namespace seamflow
