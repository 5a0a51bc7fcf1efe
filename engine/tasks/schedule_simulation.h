#pragma once

#include <vector>

#include "engine/tasks/schedule.h"

namespace seamflow {

/// One step of a schedule as it would be with another number of threads.
struct Simulation {
    int workers = 1;
    /// Seconds of all tasks together.
    double work = 0.0;
    /// Seconds from the start of the first task to the end of the last one.
    double makespan = 0.0;
    /// Seconds of the longest chain of tasks that wait for each other, without those that all workers share: no number
    /// of workers takes less.
    double critical_path_seconds = 0.0;
    /// The tasks of such a chain (numbers in Schedule::tasks), in order.
    std::vector<Index> critical_path;

    /// work / makespan; 1 if nothing ran.
    [[nodiscard]] double speed_up() const;
    /// work / (workers · makespan).
    [[nodiscard]] double efficiency() const;
};

/// Replays a step on a number of workers by list scheduling (Graham 1969): whenever a worker is free and a task ready,
/// the ready task with the highest priority starts, the one with the lowest number among equals, and lasts as long as
/// it was recorded to last. The solution on the interface is shared by all workers evenly, as its loops are. Workers
/// share nothing that slows them down, and starting a task costs nothing: only the graph is measured. Deterministic.
/// @param step from 1.
/// @param workers their number, at least 1.
/// @throws OptionError for a step that was not recorded, or without workers.
Simulation simulate(const Schedule& schedule, int step, int workers);

}  // namespace seamflow
