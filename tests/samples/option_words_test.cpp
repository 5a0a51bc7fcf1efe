// What the library says of fields, said of options and of keywords.

#include <doctest/doctest.h>

#include "samples/process/option_words.h"

using namespace seamflow;

TEST_CASE("fields become options, where they are what a message is about and where nothing else is called so")
{
    CHECK(in_words_of_options("memory_limit is 3, but must be at least 4") ==
          "--memory-limit is 3, but must be at least 4");
    CHECK(in_words_of_options("tolerance is 2, but must be below 1") == "--converge is 2, but must be below 1");
    CHECK(in_words_of_options("p is -1: leave p out") == "--p is -1: leave p out");
    CHECK(in_words_of_options("raise it, or use sweeps (Approach::Sweep)") ==
          "raise it, or use sweeps (--approach sweep)");
    CHECK(
        in_words_of_options("rescale moves every vertex, but fixed_vertices are to stay; Filter::LowPass lets them") ==
        "--rescale moves every vertex, but --fix are to stay; --filter low-pass lets them");
    CHECK(in_words_of_options("attachment_weights: too few") == "--attach-weights: too few");
    for (const char* text : {"my_time_step.obj: cannot be read", "memory_limits are other things", "a/keep_edges/b",
                             "a/keep_edges is missing", "my_time_step 3", "keep_edges.txt is missing",
                             "the flow is slow", "", "precisely p"})
        CHECK(in_words_of_options(text) == text);
}

TEST_CASE("options become keywords")
{
    CHECK(in_words_of_keywords("--radius says how much; --time-step-edges 3 does, too (--fix)") ==
          "radius says how much; time_step_edges 3 does, too (fix)");
    for (const char* text : {"a -- b", "--", "a--b", "x/--y", "--9"})
        CHECK(in_words_of_keywords(text) == text);
}
