#pragma once

#include <iosfwd>
#include <vector>

#include "engine/tasks/schedule_simulation.h"

namespace seamflow {

/// A table with one line per simulation: workers, makespan, efficiency, speed-up and critical path, times in
/// milliseconds.
void print_simulations(std::ostream& out, const std::vector<Simulation>& simulations);

}  // namespace seamflow
