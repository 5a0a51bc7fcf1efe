#include <set>
#include <string_view>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"
#include "tests/support/flows.h"

using namespace seamflow;

TEST_CASE("every Laplacian has a name of its own")
{
    std::set<std::string_view> names;
    for (const Laplacian laplacian : test::all_laplacians)
        names.insert(name_of(laplacian));
    CHECK(names.size() == test::all_laplacians.size());
    CHECK(names.count("") == 0);
    CHECK(name_of(Laplacian::AlexaWardetzky) == "alexa-wardetzky");
    CHECK(names_of_symmetric_laplacians() == "fujiwara, alexa-wardetzky, virtual-refinement or uniform");
}

TEST_CASE("every Laplacian has traits of its own, and is tested")
{
    CHECK(all_laplacian_traits().size() == test::all_laplacians.size());
    for (const Laplacian laplacian : test::all_laplacians)
        CHECK(traits_of(laplacian).laplacian == laplacian);
    CHECK_THROWS_AS(traits_of(static_cast<Laplacian>(99)), OptionError);
}
