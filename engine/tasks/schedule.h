#pragma once

#include <string_view>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The work of a task for its sub-mesh (the last three: in converged steps).
enum class TaskKind {
    AssembleAndFactorise,
    Predict,
    UsePredictions,
    Solve,
    Accept,
    Condense,
    SolveInterface,
    BackSubstitute,
};

/// The name of the work: "assemble and factorise", "solve" and so on.
std::string_view name_of(TaskKind kind);

/// Whether such tasks start before others that are ready: in a sweep, tasks that free a factor come before tasks that
/// make one.
bool has_priority(TaskKind kind);

/// A task of the graph. It runs at most once in a step.
struct ScheduledTask {
    TaskKind kind = TaskKind::Solve;
    /// The number of the sub-mesh; -1: none.
    Index sub_mesh = 0;
};

/// Task `after` starts only when task `before` is done; both are indices in Schedule::tasks.
struct Dependency {
    Index before = 0;
    Index after = 0;
};

/// One run of a task.
struct TaskRecord {
    /// The number of the step, from 1.
    int step = 0;
    /// The index in Schedule::tasks.
    Index task = 0;
    /// The slot of the thread in its TBB arena, from 0; the calling thread has one of the slots.
    int thread = 0;
    /// Seconds since the first step began.
    double start = 0.0;
    double end = 0.0;
};

/// One step, from its first task to the joining of all sub-meshes.
struct StepRecord {
    /// Seconds since the first step began.
    double start = 0.0;
    double end = 0.0;
};

/// The tasks of a flow with their times, and their dependencies.
struct Schedule {
    /// The tasks of all sweeps; a step runs only the tasks of its own sweep.
    std::vector<ScheduledTask> tasks;
    std::vector<Dependency> dependencies;
    /// The runs of tasks in the order of steps; within a step in the order of tasks.
    std::vector<TaskRecord> records;
    /// One per step.
    std::vector<StepRecord> steps;
};

}  // namespace seamflow
