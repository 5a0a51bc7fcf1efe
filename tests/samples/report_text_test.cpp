#include <sstream>

#include <doctest/doctest.h>

#include "samples/common/report_text.h"
#include "samples/common/smoothing_request.h"

using namespace seamflow;

TEST_CASE("the amount of smoothing in all its units")
{
    FlowOptions options;
    options.steps = 3;
    options.time_step = time_step_for_radius(0.5, options.steps);
    std::ostringstream text;
    print_amount(text, {.mean_edge = 0.1, .diagonal = 2.0}, options);
    CHECK(text.str().find("3 steps smooth bumps of radius 0.5 = 25% of the diagonal") != std::string::npos);
    std::ostringstream edges;
    edges << "= " << options.time_step / 0.01;
    CHECK(text.str().find(edges.str() + " squared mean edge lengths") != std::string::npos);
}

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
