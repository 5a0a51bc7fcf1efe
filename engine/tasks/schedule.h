#pragma once

#include <string_view>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// What a task does for its sub-mesh (the last three: in converged steps).
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

/// In words: "assemble and factorise", "solve" and so on.
std::string_view name_of(TaskKind kind);

/// Whether such tasks start before others that are ready: in a sweep what frees a factor comes before what makes one.
bool has_priority(TaskKind kind);

/// A task of the graph. It runs at most once in a step.
struct ScheduledTask {
    TaskKind kind = TaskKind::Solve;
    /// -1: none.
    Index sub_mesh = 0;
};

/// `after` starts when `before` is done; both are numbers of tasks.
struct Dependency {
    Index before = 0;
    Index after = 0;
};

/// One run of a task.
struct TaskRecord {
    /// From 1.
    int step = 0;
    /// Its number in Schedule::tasks.
    Index task = 0;
    /// Slot of the thread in its TBB arena, from 0; the calling thread's is one of them.
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

/// What ran when in a flow, and what had to wait for what.
struct Schedule {
    /// Those of all sweeps; a step runs only the tasks of its own sweep.
    std::vector<ScheduledTask> tasks;
    std::vector<Dependency> dependencies;
    /// In order of their steps; within a step in order of their tasks.
    std::vector<TaskRecord> records;
    /// #steps.
    std::vector<StepRecord> steps;
};

}  // namespace seamflow
