#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/files/step_pattern.h"

using namespace seamflow;

TEST_CASE("a pattern becomes the name of a step's file")
{
    CHECK(StepPattern("out/step_%d.obj").path(7) == "out/step_7.obj");
    CHECK(StepPattern("%03d.ply").path(7) == "007.ply");
    CHECK(StepPattern("%03d.ply").path(1234) == "1234.ply");
    CHECK(StepPattern("%3d.ply").path(7) == "  7.ply");
    CHECK(StepPattern("100%%_%d").path(7) == "100%_7");
}

TEST_CASE("other patterns are refused")
{
    for (const char* pattern : {"step.obj", "%d_%d.obj", "%s.obj", "%d%n", "%", "%03", "%1000d", "%-3d", "%%d", "%d%"})
        CHECK_THROWS_AS(StepPattern{pattern}, OptionError);
}
