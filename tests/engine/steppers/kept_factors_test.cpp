#include <limits>

#include <doctest/doctest.h>

#include "engine/steppers/kept_factors.h"
#include "partition/errors.h"

using namespace seamflow;

namespace {

/// Together 600 bytes.
const std::vector<std::size_t> factors{100, 200, 300};

}  // namespace

TEST_CASE("without a limit that matters, all factors are kept")
{
    for (const std::optional<std::size_t> limit : {std::optional<std::size_t>(), std::optional<std::size_t>(600),
                                                   std::optional(std::numeric_limits<std::size_t>::max())}) {
        const KeptFactors kept = choose_kept_factors(factors, limit, 2);
        CHECK(kept.whole == std::vector<std::uint8_t>{1, 1, 1});
        CHECK(kept.n_live() == 3);
        CHECK(kept.most_bytes() == 600);
    }
}

TEST_CASE("the least limit has room for the largest factor")
{
    const KeptFactors kept = choose_kept_factors(factors, 300, 2);
    CHECK(kept.whole == std::vector<std::uint8_t>{0, 0, 0});
    CHECK(kept.n_slots == 1);
    CHECK(kept.bytes_per_slot == 300);
    CHECK(kept.most_bytes() == 300);
    CHECK_THROWS_WITH_AS(choose_kept_factors(factors, 299, 2), doctest::Contains("take 300"), OptionError);
}

TEST_CASE("a higher limit keeps the largest factors that fit")
{
    // With the third kept: 300 + 200.
    CHECK(choose_kept_factors(factors, 499, 1).whole == std::vector<std::uint8_t>{0, 0, 0});
    const KeptFactors one = choose_kept_factors(factors, 500, 1);
    CHECK(one.whole == std::vector<std::uint8_t>{0, 0, 1});
    CHECK(one.most_bytes() == 500);
    CHECK(one.n_live() == 2);
}

TEST_CASE("those made again have places enough that the fewest rounds are made, and no more")
{
    const std::vector<std::size_t> many(100, 100);
    const auto check = [&](std::size_t limit, Index n_threads, Index n_whole, Index n_slots) {
        const KeptFactors kept = choose_kept_factors(many, limit, n_threads);
        CHECK(kept.n_whole == n_whole);
        CHECK(kept.n_slots == n_slots);
        CHECK(kept.most_bytes() == 100 * usize(n_whole + n_slots));
        CHECK(kept.most_bytes() <= limit);
    };
    check(9999, 1, 98, 1);
    // With two places 97 would be kept: as many rounds, but more made again. The same with sixteen.
    check(9999, 2, 98, 1);
    check(9999, 16, 98, 1);
    check(5000, 4, 46, 4);
    check(1199, 16, 3, 8);
    check(1400, 3, 11, 3);
    CHECK_THROWS_AS(choose_kept_factors(many, 99, 3), OptionError);
}

TEST_CASE("a mesh in which nothing moves has no factors")
{
    CHECK(choose_kept_factors({}, 1, 1).n_live() == 0);
    CHECK(choose_kept_factors(std::vector<std::size_t>(2), 1, 1).most_bytes() == 0);
}
