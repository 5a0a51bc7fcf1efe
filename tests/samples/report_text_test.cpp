#include <sstream>

#include <doctest/doctest.h>

#include "engine/setup/smoothing_amount.h"
#include "samples/common/report_text.h"

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
