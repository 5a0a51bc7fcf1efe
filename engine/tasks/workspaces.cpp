#include "engine/tasks/workspaces.h"

#include <algorithm>

#include <oneapi/tbb/task_arena.h>

#include "engine/tasks/parallel_executor.h"

namespace seamflow {

namespace arena = oneapi::tbb::this_task_arena;

Workspaces::Workspaces()
    : n_threads_(n_threads_of_arena())
    // An arena of one thread gets a second one for tasks enqueued from outside (see TaskGraph::signal).
    , workspaces_(std::max(usize(n_threads_), std::size_t{2}))
{
}

SolverWorkspace& Workspaces::local()
{
    return workspaces_.at(static_cast<std::size_t>(arena::current_thread_index()));
}

}  // namespace seamflow
