// The linker puts these functions in the place of those of the library (--wrap, see CMakeLists.txt): the library has no
// part in it. They are called by the names that compilers give them.

#include "tests/faults/failing_work.h"

#include <atomic>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <umfpack.h>

#include "engine/tasks/task_graph.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/lu_solver.h"

namespace seamflow::test {

namespace {

std::atomic<int> failing_task{0};
std::atomic<int> failing_run{0};
std::atomic<bool> task_failed{false};

/// 0: none.
std::atomic<int> failing_factorisation{0};
std::atomic<bool> goes_on{false};
std::atomic<int> n_factorisations{0};

bool factorisation_fails()
{
    const int first = failing_factorisation;
    if (first == 0)
        return false;
    const int n = ++n_factorisations;
    return n == first || (n > first && goes_on);
}

/// Programs have no other way of being told.
const bool told_by_environment = [] {
    if (const char* const n = std::getenv("FAIL_FACTORISATION"))
        failing_factorisation = std::atoi(n), goes_on = true;
    return true;
}();

}  // namespace

FailingTask::FailingTask(int task, int run)
{
    task_failed = false;
    failing_run = run;
    failing_task = task;
}

FailingTask::~FailingTask()
{
    failing_task = 0;
}

bool FailingTask::has_failed() const
{
    return task_failed;
}

FailingFactorisation::FailingFactorisation(int n, After after)
{
    n_factorisations = 0;
    goes_on = after == After::Fails;
    failing_factorisation = n;
}

FailingFactorisation::~FailingFactorisation()
{
    failing_factorisation = 0;
}

bool FailingFactorisation::has_failed() const
{
    return n_factorisations >= failing_factorisation;
}

}  // namespace seamflow::test

using namespace seamflow;
using namespace seamflow::test;

#define SEAMFLOW_ADD_TASK "_ZN8seamflow9TaskGraph8add_taskESt8functionIFvvEERKNS_13ScheduledTaskE"
#define SEAMFLOW_LDL(number)                                                                                           \
    "_ZNK8seamflow9LdlSolver9factoriseI" number                                                                        \
    "EESt8optionalINS_9LdlFactorIT_EEESt4spanIKdLm18446744073709551615EERNSt3pmr15memory_resourceERNS_"                \
    "12LdlWorkspaceES4_"
#define SEAMFLOW_LU                                                                                                    \
    "_ZNK8seamflow8LuSolver9factoriseESt4spanIKdLm18446744073709551615EERNSt3pmr15memory_resourceERNS_11LuWorkspaceE"

using Values = std::span<const double>;

TaskGraph::Node real_add_task(TaskGraph* graph, std::function<void()> body,
                              const ScheduledTask& task) asm("__real_" SEAMFLOW_ADD_TASK);
using SingleFactor = std::optional<LdlFactor<float>>;
using DoubleFactor = std::optional<LdlFactor<double>>;
using LuFactor = std::optional<LuSolver::Factor>;
SingleFactor real_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      float least_pivot) asm("__real_" SEAMFLOW_LDL("f"));
DoubleFactor real_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      double least_pivot) asm("__real_" SEAMFLOW_LDL("d"));
LuFactor real_lu(const LuSolver* solver, Values values, FactorMemory& memory,
                 LuWorkspace& workspace) asm("__real_" SEAMFLOW_LU);

namespace {

/// The number of the task that was added at a node, from 1. In a new graph nodes begin anew. Ranks that are threads
/// build theirs at the same time.
int number_at(TaskGraph::Node node)
{
    thread_local TaskGraph::Node latest = 0;
    thread_local int n = 0;
    n = node > latest ? n + 1 : 1;
    latest = node;
    return n;
}

}  // namespace

TaskGraph::Node wrap_add_task(TaskGraph* graph, std::function<void()> body,
                              const ScheduledTask& task) asm("__wrap_" SEAMFLOW_ADD_TASK);
TaskGraph::Node wrap_add_task(TaskGraph* graph, std::function<void()> body, const ScheduledTask& task)
{
    auto number = std::make_shared<int>(0);
    auto failing = [number, n_runs = 0, body = std::move(body)]() mutable {
        if (*number == failing_task && ++n_runs == failing_run) {
            task_failed = true;
            throw TaskFailure{*number};
        }
        body();
    };
    const TaskGraph::Node node = real_add_task(graph, std::move(failing), task);
    *number = number_at(node);
    return node;
}

SingleFactor wrap_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      float least_pivot) asm("__wrap_" SEAMFLOW_LDL("f"));
SingleFactor wrap_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      float least_pivot)
{
    SingleFactor factor = real_ldl(solver, values, memory, workspace, least_pivot);
    return factor && factorisation_fails() ? std::nullopt : std::move(factor);
}

DoubleFactor wrap_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      double least_pivot) asm("__wrap_" SEAMFLOW_LDL("d"));
DoubleFactor wrap_ldl(const LdlSolver* solver, Values values, FactorMemory& memory, LdlWorkspace& workspace,
                      double least_pivot)
{
    DoubleFactor factor = real_ldl(solver, values, memory, workspace, least_pivot);
    return factor && factorisation_fails() ? std::nullopt : std::move(factor);
}

LuFactor wrap_lu(const LuSolver* solver, Values values, FactorMemory& memory,
                 LuWorkspace& workspace) asm("__wrap_" SEAMFLOW_LU);
LuFactor wrap_lu(const LuSolver* solver, Values values, FactorMemory& memory, LuWorkspace& workspace)
{
    LuFactor factor = real_lu(solver, values, memory, workspace);
    return factor && factorisation_fails() ? std::nullopt : std::move(factor);
}

extern "C" {

int real_umfpack(const int* offsets, const int* rows, const double* values, void* symbolic, void** numeric,
                 const double* control, double* info) asm("__real_umfpack_di_numeric");
int wrap_umfpack(const int* offsets, const int* rows, const double* values, void* symbolic, void** numeric,
                 const double* control, double* info) asm("__wrap_umfpack_di_numeric");
int wrap_umfpack(const int* offsets, const int* rows, const double* values, void* symbolic, void** numeric,
                 const double* control, double* info)
{
    const int status = real_umfpack(offsets, rows, values, symbolic, numeric, control, info);
    return status == UMFPACK_OK && factorisation_fails() ? UMFPACK_WARNING_singular_matrix : status;
}

}  // extern "C"
