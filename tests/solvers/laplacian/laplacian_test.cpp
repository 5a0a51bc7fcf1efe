#include <doctest/doctest.h>

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
