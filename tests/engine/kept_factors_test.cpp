#include <limits>

#include <doctest/doctest.h>

#include "engine/kept_factors.h"
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

TEST_CASE("beyond that the limit goes to places for the threads first, and then to the factors that fit")
{
    // Of the first factor 90 bytes more than its block, of the second 180.
    const KeptFactors one = choose_kept_factors(factors, 449, 1);
    CHECK(one.n_live() == 1);
    const KeptFactors first = choose_kept_factors(factors, 450, 1);
    CHECK(first.whole == std::vector<std::uint8_t>{1, 0, 0});
    CHECK(first.most_bytes() == 450);
    const KeptFactors threads_first = choose_kept_factors({factors.begin(), 2}, 299, 1);
    CHECK(threads_first.whole == std::vector<std::uint8_t>{0, 0});

    const std::vector<FactorBytes> many(100, {100, 10});
    const KeptFactors of_many = choose_kept_factors(many, 1000 + 3 * 100 + 5 * 90 + 89, 3);
    CHECK(of_many.n_places == 3);
    CHECK(of_many.n_whole == 5);
    CHECK(of_many.most_bytes() == 1000 + 3 * 100 + 5 * 90);
    CHECK(choose_kept_factors(many, 1000 + 2 * 100 + 99, 3).n_places == 2);
}

TEST_CASE("a mesh in which nothing moves has no factors")
{
    CHECK(choose_kept_factors({}, 1, 1).n_live() == 0);
    CHECK(choose_kept_factors(std::vector<FactorBytes>(2), 1, 1).most_bytes() == 0);
}
