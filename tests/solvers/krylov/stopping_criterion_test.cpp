#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

#include "solvers/krylov/stopping_criterion.h"

using namespace seamflow;

TEST_CASE("stagnation is several measurements with too little progress one after the other")
{
    StoppingCriterion criterion({1e-9, 1000}, 0.5, 1.0);
    for (const double left : {0.9, 0.6, 0.5, 0.9, 0.9}) {
        criterion.note(1, 1.0, left);
        CHECK(criterion.is_stalling() == (left > 0.5));
        CHECK_FALSE(criterion.is_met());
    }
    criterion.note(1, 1.0, std::numeric_limits<double>::quiet_NaN());
    CHECK(criterion.is_met());
    CHECK(criterion.result(1.0).stagnated);
    CHECK(criterion.result(1.0).iterations == 6);
    CHECK_FALSE(criterion.result(1e-10).stagnated);
    criterion.note(1, 1.0, 0.4);
    CHECK_FALSE(criterion.is_met());
}

TEST_CASE("an iteration ends where its residual is small enough or none, or its iterations have run out")
{
    CHECK(StoppingCriterion({1e-3, 10}, 0.5, 1e-3).is_met());
    CHECK_FALSE(StoppingCriterion({1e-3, 10}, 0.5, 2e-3).is_met());
    CHECK(StoppingCriterion({1e-3, 10}, 0.5, std::numeric_limits<double>::quiet_NaN()).is_met());
    CHECK(StoppingCriterion({1e-3, 0}, 0.5, 1.0).is_met());
    StoppingCriterion criterion({1e-3, 3}, 0.5, 1.0);
    for (int i = 0; i < 3; ++i) {
        CHECK(criterion.iterations_left() == 3 - i);
        criterion.note(1, 1.0, 1.0);
    }
    CHECK(criterion.is_met());
    // The last ones may have been too few to get on.
    CHECK_FALSE(criterion.result(1.0).stagnated);
    CHECK(criterion.result(1.0).residual == 1.0);
}
