#include "samples/common/simulation_text.h"

#include <cstdio>
#include <ostream>

namespace seamflow {

void print_simulations(std::ostream& out, const std::vector<Simulation>& simulations)
{
    out << "workers      makespan  efficiency  speed-up            critical path\n";
    for (const Simulation& simulation : simulations) {
        char line[160];
        std::snprintf(line, sizeof line, "%7d  %9.3f ms  %10.3f  %8.2f  %9.3f ms, %3zu tasks\n", simulation.workers,
                      1e3 * simulation.makespan, simulation.efficiency(), simulation.speed_up(),
                      1e3 * simulation.critical_path_seconds, simulation.critical_path.size());
        out << line;
    }
}

}  // namespace seamflow
