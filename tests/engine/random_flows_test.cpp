#include <cstdlib>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/random_case.h"
#include "tests/support/seed_announcer.h"

using namespace seamflow;

namespace {

/// A number from the environment.
std::uint32_t from_environment(const char* name, std::uint32_t otherwise)
{
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::stoul(text));
}

/// Which seeds: SEAMFLOW_SEED runs that one alone, or the first of SEAMFLOW_CASES.
struct Seeds {
    std::uint32_t first = from_environment("SEAMFLOW_SEED", 1);
    std::uint32_t count = from_environment("SEAMFLOW_CASES", std::getenv("SEAMFLOW_SEED") != nullptr ? 1 : 3000);
};

void check(test::Case& c)
{
    check_result(c);
    check_threads(c);
    check_undecomposed(c);
    check_rescaled(c);
    check_mirrored_and_scaled(c);
    switch (c.random.below(4)) {
    case 0:
        check_memory_limit(c);
        break;
    case 1:
        check_resume(c);
        break;
    case 2:
        check_cancelled(c);
        break;
    default:
        check_turned_and_renumbered(c);
        break;
    }
}

/// How many cases ended in which way, and in how many something was compared.
struct Counts {
    std::map<std::string, int> ends;
    std::map<std::string, int> compared;
};

/// What was found wrong with one case, by which it can be run again; empty: nothing.
std::string complaints_about(std::uint32_t seed, Counts& counts)
{
    test::Case c = test::random_case(seed);
    ++counts.ends[c.expected.refusal.empty() ? "succeeded" : c.expected.refusal];
    check(c);
    for (const auto& [what, n] : c.n_compared)
        counts.compared[what] += n > 0 ? 1 : 0;
    std::string text;
    for (const std::string& complaint : c.complaints)
        text += "\n  " + complaint;
    return text.empty() ? text : "SEAMFLOW_SEED=" + std::to_string(seed) + ": " + c.flow.description() + text;
}

}  // namespace

TEST_CASE("random flows of random meshes keep all that is promised of every flow")
{
    const Seeds seeds;
    test::SeedAnnouncer announcer;
    Counts counts;
    for (std::uint32_t i = 0; i < seeds.count; ++i) {
        const std::uint32_t seed = seeds.first + i;
        announcer.begin(seed, 120);
        const std::string complaints = complaints_about(seed, counts);
        CHECK_MESSAGE(complaints.empty(), complaints);
    }
    if (std::getenv("SEAMFLOW_CASES") != nullptr)
        for (const auto* of : {&counts.ends, &counts.compared})
            for (const auto& [kind, count] : *of)
                MESSAGE(count << " " << kind);
    // Of a few cases, whichever they are, nothing can be said.
    const auto n_cases = static_cast<int>(seeds.count);
    if (n_cases < 1000)
        return;
    // Checks of refusals alone, or that always find nothing to compare, would be none.
    CHECK(counts.ends["succeeded"] * 5 > 4 * n_cases);
    for (const char* what : {"undecomposed", "converged", "rescaled", "mirrored and scaled", "memory limit", "resumed",
                             "stopped", "turned and renumbered"}) {
        CAPTURE(what);
        CHECK(counts.compared[what] * 50 > n_cases);
    }
}
