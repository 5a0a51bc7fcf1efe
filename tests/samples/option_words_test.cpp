// What the library says of fields, said of options and of keywords.

#include <doctest/doctest.h>

#include "partition/remark.h"
#include "samples/process/option_words.h"

using namespace seamflow;

TEST_CASE("command lines have names of their own for what the library calls otherwise")
{
    const auto said = [](const char* text) { return sentence(Wording{text}, option_of_program); };
    CHECK(said("<memory_limit> is 3, but must be at least 4") == "--memory-limit is 3, but must be at least 4");
    CHECK(said("<tolerance> is 2, but must be below 1") == "--converge is 2, but must be below 1");
    CHECK(said("<p> is -1: leave <p> out") == "--p is -1: leave --p out");
    CHECK(said("raise it, or use sweeps (<approach sweep>)") == "raise it, or use sweeps (--approach sweep)");
    CHECK(said("<rescale> moves every vertex, but <fixed_vertices> holds some; <filter low-pass> lets them") ==
          "--rescale moves every vertex, but --fix holds some; --filter low-pass lets them");
    CHECK(said("<attachment_weights>: too few") == "--attach-weights: too few");
    CHECK(said("<denoise>, <preset cad>, <fwhm> and <--parts>") ==
          "--preset automatic, --preset cad, --fwhm and --parts");
    // It is no option of programs.
    CHECK(said("<largest_update> is 0") == "largest_update is 0");
    for (const char* text : {"time_step.obj: cannot be read", "keep_edges is missing", "the flow is slow", ""})
        CHECK(said(text) == text);
}

TEST_CASE("options become keywords")
{
    CHECK(in_words_of_keywords("--radius says how much; --time-step-edges 3 does, too (--fix)") ==
          "radius says how much; time_step_edges 3 does, too (fix)");
    for (const char* text : {"a -- b", "--", "a--b", "x/--y", "--9"})
        CHECK(in_words_of_keywords(text) == text);
}
