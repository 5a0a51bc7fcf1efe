#include <algorithm>

#include <doctest/doctest.h>

#include "samples/page/shown_steps.h"

using namespace seamflow;

TEST_CASE("a page of a small mesh shows all steps")
{
    CHECK(shown_steps(0, 100, true).empty());
    CHECK(shown_steps(4, 100, false) == std::vector<int>{1, 2, 3, 4});
    CHECK(remark_on_shown_steps(4, 4).empty());
    CHECK(remark_on_shown_steps(0, 0).empty());
    CHECK(shown_steps(3, 0, true).size() == 3);
}

TEST_CASE("of more than fit it shows some, evenly, and the last one")
{
    for (const int steps : {2, 7, 100, 1000, 1'000'000})
        for (const Index vertices : {1000, 500'000, 10'000'000, 2'000'000'000})
            for (const bool undecomposed : {false, true}) {
                const std::vector<int> shown = shown_steps(steps, vertices, undecomposed);
                CAPTURE(steps);
                CAPTURE(vertices);
                REQUIRE_FALSE(shown.empty());
                CHECK(shown.size() <= 200);
                CHECK(shown.front() >= 1);
                CHECK(shown.back() == steps);
                CHECK(std::adjacent_find(shown.begin(), shown.end(), std::greater_equal<>()) == shown.end());
                const double spacing = static_cast<double>(steps) / static_cast<double>(shown.size());
                for (std::size_t k = 0; k < shown.size(); ++k)
                    CHECK(std::abs(shown[k] - spacing * static_cast<double>(k + 1)) <= 0.5 + 1e-6);
            }
    CHECK(shown_steps(100, 500'000, true).size() < shown_steps(100, 500'000, false).size());
    CHECK(remark_on_shown_steps(100, 2).find("2 of the 100 steps") != std::string::npos);
}
