#include "engine/tasks/parallel_executor.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include "solvers/platform/thread_sanitizer.h"

namespace seamflow {

namespace tbb = oneapi::tbb;

void run_in_parallel(Index n, const RangeBody& body)
{
    const SharedWork work;
    tbb::parallel_for(tbb::blocked_range<Index>(0, n), [&](const tbb::blocked_range<Index>& range) {
        const SharedWork::Part part(work);
        body(range.begin(), range.end());
    });
}

int n_threads_of_arena()
{
    return tbb::this_task_arena::max_concurrency();
}

void run_both(const std::function<void()>& one, const std::function<void()>& other)
{
    const SharedWork work;
    const auto run = [&](const std::function<void()>& body) {
        const SharedWork::Part part(work);
        body();
    };
    tbb::parallel_invoke([&] { run(one); }, [&] { run(other); });
}

}  // namespace seamflow
