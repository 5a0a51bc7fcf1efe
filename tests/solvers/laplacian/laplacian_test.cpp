#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"
#include "tests/support/flows.h"

using namespace seamflow;

TEST_CASE("Laplacians are found by their names")
{
    for (const Laplacian laplacian : test::all_laplacians)
        CHECK(laplacian_named(name_of(laplacian)) == laplacian);
    CHECK(name_of(Laplacian::AlexaWardetzky) == "alexa-wardetzky");
    CHECK(!laplacian_named("cotan"));
    CHECK(!laplacian_named(""));
}

TEST_CASE("every Laplacian has traits of its own, and is tested")
{
    CHECK(all_laplacian_traits().size() == test::all_laplacians.size());
    for (const Laplacian laplacian : test::all_laplacians)
        CHECK(traits_of(laplacian).laplacian == laplacian);
    CHECK_THROWS_AS(traits_of(static_cast<Laplacian>(99)), OptionError);
}
