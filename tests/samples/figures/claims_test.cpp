#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "samples/figures/claims.h"
#include "samples/figures/experiments.h"
#include "tests/samples/figures/made_up.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("claims are computed from the numbers of a table")
{
    CHECK(claims_of(wavy_table(0.2, 0.01))[0].holds);
    CHECK(claims_of(wavy_table(0.2, 0.01))[1].holds);
    CHECK_FALSE(claims_of(wavy_table(0.09, 0.01))[0].holds);
    CHECK(claims_of(wavy_table(0.09, 0.01))[1].holds);
    CHECK(claims_of(wavy_table(0.2, 0.01))[0].measured == "Schwarz 0.2, Robin 0.01");
}

TEST_CASE("a claim does not hold where a number is missing")
{
    Table table;
    for (const Experiment& experiment : experiments()) {
        table.figure = experiment.name;
        table.is_theirs = true;
        CHECK_FALSE(claims_of(table).empty());
        for (const Claim& claim : claims_of(table))
            CHECK_FALSE(claim.holds);
    }
    for (const Claim& claim : claims_of_many({}))
        CHECK_FALSE(claim.holds);
}

TEST_CASE("claims are written as CSV, with the reason where they do not hold")
{
    const test::TemporaryDirectory folder;
    const std::vector<Claim> claims{{"a", "b, c", "1", true, ""}, {"d", "e", "2, 3", false, "so it is"}};
    write_claims(folder / "claims.csv", claims);
    CHECK(test::content_of(folder / "claims.csv") ==
          "figure,claim,measured,holds,why\na,\"b, c\",1,yes,\nd,e,\"2, 3\",no,so it is\n");
    std::ostringstream said;
    print_claims(said, claims);
    CHECK(said.str() == "holds          a: b, c\n               1\n"
                        "does not hold  d: e\n               2, 3\n               so it is\n");
}

TEST_CASE("spikes are claimed where they are seen, artifacts where the surface is twice as rough as before")
{
    Table table;
    table.figure = "hexagons";
    table.steps = 2;
    table.roughness.rms = 5.0;
    const auto rough_row = [](Laplacian laplacian, int step, double roughness) {
        Row made = row(laplacian, "undecomposed", 0.0);
        made.step = step;
        made.roughness.rms = roughness;
        return made;
    };
    table.rows = {rough_row(alexa, 1, 50.0), rough_row(alexa, 2, 60.0)};
    const Claim spiky = claims_of(table).back();
    CHECK(spiky.holds);
    CHECK(spiky.measured == "Δ_A 60, input 5, first above in step 1");
    table.rows = {rough_row(alexa, 1, 50.0), rough_row(alexa, 2, 44.0)};
    CHECK_FALSE(claims_of(table).back().holds);

    table.figure = "polygons";
    table.rows = {rough_row(alexa, 2, 10.1), rough_row(velho, 2, 9.9)};
    CHECK(claims_of(table)[1].holds);
    CHECK(claims_of(table)[2].holds);
    table.rows = {rough_row(alexa, 2, 9.9), rough_row(velho, 2, 10.1)};
    CHECK_FALSE(claims_of(table)[1].holds);
    CHECK_FALSE(claims_of(table)[2].holds);
}

TEST_CASE(
    "an interface is straightened where it is shorter with the tangential derivative than without, by all Laplacians")
{
    Table table;
    table.figure = "texture";
    table.steps = 5;
    const auto long_row = [](Laplacian laplacian, const std::string& conditions, double length) {
        Row made = row(laplacian, conditions, 0.1);
        made.interface_length = length;
        return made;
    };
    for (const Laplacian laplacian : {fujiwara, alexa, velho}) {
        table.rows.push_back(long_row(laplacian, "adapted-robin", 0.99));
        table.rows.push_back(long_row(laplacian, "adapted-ventcell", 0.98));
    }
    CHECK(claims_of(table).back().holds);
    table.rows.back().interface_length = 0.995;
    CHECK_FALSE(claims_of(table).back().holds);
}

TEST_CASE("what does not hold says why")
{
    Table table;
    table.figure = "hexagons";
    table.steps = 5;
    table.rows = {row(fujiwara, "adapted-robin", 0.2), row(velho, "adapted-robin", 0.6)};
    CHECK_FALSE(claims_of(table)[0].holds);
    CHECK(claims_of(table)[0].why.find("0.67 for Δ_P") != std::string::npos);
    table.rows[1].v.mean = 0.4;
    CHECK(claims_of(table)[0].holds);
    CHECK(claims_of(table)[0].why.empty());
}

TEST_CASE("of many sub-meshes every flow counts that was to run beside a smooth reference")
{
    const auto with_title = [](Row made, const Variant& variant) {
        made.title = title_of(variant);
        return made;
    };
    const Variant plain{.laplacian = velho, .cut = CutKind::Metis, .subdomains = 4};
    Variant ours = plain;
    ours.settings = Settings::Default;
    Table many;
    many.figure = "hexagons";
    many.steps = 5;
    many.flows = {{.laplacian = velho}, plain, ours};
    many.rows = {with_title(row(velho, "undecomposed", 0.0), {.laplacian = velho}),
                 with_title(row(velho, "adapted-robin", 0.5), plain),
                 with_title(row(velho, "adapted-robin", 0.4), ours)};
    for (const Claim& claim : claims_of_many({many}))
        CHECK(claim.holds);
    many.rows[2].v.mean = 0.75;
    CHECK(claims_of_many({many})[0].why == "Not so: hexagons, Δ_P, 4 sub-meshes: plain 0.5, default 0.75.");
    CHECK(claims_of_many({many})[1].why ==
          "Not so: hexagons, Δ_P, 4 sub-meshes: V_mean 0.75, roughness of the undecomposed flow 0, of the input 0.");
    // Ended early.
    many.rows[2].step = 4;
    for (const Claim& claim : claims_of_many({many})) {
        CHECK(claim.measured == "0 of 1");
        CHECK_FALSE(claim.holds);
        CHECK(claim.why.find("none") != std::string::npos);
    }
    many.rows[1].step = 4;
    many.rows[2].step = 5;
    CHECK(claims_of_many({many})[0].holds);
    many.rows[0].roughness.rms = 46.0;
    CHECK(claims_of_many({many})[0].measured == "0 of 0");
}

TEST_CASE("the authors' numbers are claimed of their own mesh alone, to the digits given")
{
    Table table = wavy_table(0.2, 0.0);
    const std::size_t without = claims_of(table).size();
    table.is_theirs = true;
    table.rows[1].v.mean = 0.0114;
    table.rows[1].v.max = 0.204;
    table.rows[3].v.mean = 0.0276;
    table.rows[3].v.max = 0.296;
    REQUIRE(claims_of(table).size() == without + 1);
    CHECK(claims_of(table).back().holds);
    for (const auto k : {std::size_t{1}, std::size_t{3}}) {
        Table other = table;
        other.rows[k].v.mean += 0.001;
        CHECK_FALSE(claims_of(other).back().holds);
        other = table;
        other.rows[k].v.max += 0.01;
        CHECK_FALSE(claims_of(other).back().holds);
    }
}
