#include <limits>

#include <doctest/doctest.h>

#include "engine/memory/kept_factors.h"
#include "partition/errors.h"

using namespace seamflow;

namespace {

/// Together 600 bytes, 60 of them on Γ.
const std::vector<FactorBytes> factors{{100, 10}, {200, 20}, {300, 30}};

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

TEST_CASE("the least limit has room for the largest factor beside all blocks on Γ")
{
    const KeptFactors kept = choose_kept_factors(factors, 360, 2);
    CHECK(kept.whole == std::vector<std::uint8_t>{0, 0, 0});
    CHECK(kept.n_places == 1);
    CHECK(kept.bytes_per_place == 300);
    CHECK(kept.most_bytes() == 360);
    CHECK_THROWS_WITH_AS(choose_kept_factors(factors, 359, 2), doctest::Contains("take 360"), OptionError);
}

TEST_CASE("the least limit is lower where keeping factors takes less than making them twice")
{
    // Nearly all is on Γ.
    const std::vector<FactorBytes> on_interface(2, {128, 80});
    CHECK(choose_kept_factors(on_interface, 256, 1).n_whole == 2);
    CHECK_THROWS_WITH_AS(choose_kept_factors(on_interface, 255, 1), doctest::Contains("take 256"), OptionError);
    // The largest kept, the others made twice: 1000 + 2 · 5 + 50. None kept: 950 + 2 · 5 + 1000.
    const std::vector<FactorBytes> one_large{{50, 5}, {1000, 950}, {50, 5}};
    const KeptFactors kept = choose_kept_factors(one_large, 1060, 4);
    CHECK(kept.whole == std::vector<std::uint8_t>{0, 1, 0});
    CHECK(kept.bytes_per_place == 50);
    CHECK(kept.most_bytes() == 1060);
    CHECK_THROWS_WITH_AS(choose_kept_factors(one_large, 1059, 4), doctest::Contains("take 1060"), OptionError);
}

TEST_CASE("a higher limit keeps the largest factors that fit")
{
    // With the third kept: 300 + 10 + 20 + 200; with the second, too: 500 + 10 + 100.
    CHECK(choose_kept_factors(factors, 529, 1).whole == std::vector<std::uint8_t>{0, 0, 0});
    const KeptFactors one = choose_kept_factors(factors, 530, 1);
    CHECK(one.whole == std::vector<std::uint8_t>{0, 0, 1});
    CHECK(one.most_bytes() == 530);
    CHECK(one.n_live() == 2);
}

TEST_CASE("those made twice have places enough that the fewest rounds are made, and no more")
{
    const std::vector<FactorBytes> many(100, {100, 10});
    // Of n kept with p places: 1000 + 90 n + 100 p.
    const auto check = [&](std::size_t limit, Index n_threads, Index n_whole, Index n_places) {
        const KeptFactors kept = choose_kept_factors(many, limit, n_threads);
        CHECK(kept.n_whole == n_whole);
        CHECK(kept.n_places == n_places);
        CHECK(kept.most_bytes() == 1000 + 90 * at(n_whole) + 100 * at(n_places));
        CHECK(kept.most_bytes() <= limit);
    };
    check(9999, 1, 98, 1);
    // With two places 97 would be kept: as many rounds, but more made twice. The same with sixteen.
    check(9999, 2, 98, 1);
    check(9999, 16, 98, 1);
    check(5000, 4, 40, 4);
    check(1199, 16, 1, 1);
    check(1400, 3, 1, 3);
    CHECK_THROWS_AS(choose_kept_factors(many, 1099, 3), OptionError);
}

TEST_CASE("a mesh in which nothing moves has no factors")
{
    CHECK(choose_kept_factors({}, 1, 1).n_live() == 0);
    CHECK(choose_kept_factors(std::vector<FactorBytes>(2), 1, 1).most_bytes() == 0);
}
