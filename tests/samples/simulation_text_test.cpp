#include <sstream>

#include <doctest/doctest.h>

#include "samples/common/simulation_text.h"

using namespace seamflow;

TEST_CASE("simulations are a table, a line each")
{
    std::ostringstream out;
    print_simulations(
        out,
        {{.workers = 1, .work = 3.0, .makespan = 3.0, .critical_path_seconds = 0.75, .critical_path = {4, 2}},
         {.workers = 1024, .work = 3.0, .makespan = 0.75, .critical_path_seconds = 0.75, .critical_path = {4, 2}}});
    CHECK(out.str() == "workers      makespan  efficiency  speed-up            critical path\n"
                       "      1   3000.000 ms       1.000      1.00    750.000 ms,   2 tasks\n"
                       "   1024    750.000 ms       0.004      4.00    750.000 ms,   2 tasks\n");
}
