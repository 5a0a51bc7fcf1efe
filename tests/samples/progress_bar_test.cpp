#include <doctest/doctest.h>

#include "samples/report/progress_bar.h"
#include "tests/support/relative.h"

using namespace seamflow;

TEST_CASE("the line of progress says what is done, how much, and what is left, as wide as there is room")
{
    const FlowProgress progress{.phase = FlowPhase::Step, .step = 3, .steps = 10, .fraction = 0.345};
    CHECK(progress_line(progress, 83.2, 60) == "step 3 of 10  [########------------------]   34 %  1:24 left");
    CHECK(progress_line(progress, std::nullopt, 36) == "step 3 of 10  [####---------]   34 %");
    CHECK(progress_line(progress, 7200.0, 30) == "step 3 of 10   34 %  2:00:00 l");
    for (int width = 0; width < 200; ++width)
        CHECK(progress_line(progress, 5.0, width).size() <= static_cast<std::size_t>(width));
    CHECK(progress_line({.phase = FlowPhase::Cut}, std::nullopt, 20) == "cutting    0 %");
    CHECK(progress_line({.phase = FlowPhase::Reference, .step = 1, .steps = 1, .fraction = 1.0}, 0.0, 60)
              .starts_with("step 1 of 1, undecomposed  [#"));
}

TEST_CASE("the time left follows from the steps alone")
{
    TimeLeft left;
    CHECK_FALSE(left.after({.phase = FlowPhase::Analyse, .fraction = 0.2}, 100.0));
    CHECK_FALSE(left.after({.phase = FlowPhase::Step, .step = 1, .steps = 4, .fraction = 0.2}, 200.0));
    CHECK_FALSE(left.after({.phase = FlowPhase::Step, .step = 1, .steps = 4, .fraction = 0.3}, 200.1));
    CHECK(*left.after({.phase = FlowPhase::Step, .step = 2, .steps = 4, .fraction = 0.4}, 202.0) ==
          test::relative(6.0, 1e-5));
    CHECK(*left.after({.phase = FlowPhase::Step, .step = 4, .steps = 4, .fraction = 1.0}, 208.0) == 0.0);
}
