#include "engine/memory/workspaces.h"

#include <oneapi/tbb/task_arena.h>

namespace seamflow {

namespace arena = oneapi::tbb::this_task_arena;

Workspaces::Workspaces()
    : workspaces_(static_cast<std::size_t>(arena::max_concurrency()))
{
}

SolverWorkspace& Workspaces::local()
{
    return workspaces_.at(static_cast<std::size_t>(arena::current_thread_index()));
}

}  // namespace seamflow
