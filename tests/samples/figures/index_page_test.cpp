#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "samples/figures/experiments.h"
#include "samples/figures/index_page.h"
#include "tests/samples/figures/made_up.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the index has every figure under its number, with its settings and commands")
{
    const Experiment experiment = small("wavy-cylinder");
    FigureResult result{.experiment = &experiment, .table = run(experiment), .claims = {}};
    result.claims = {{"wavy-cylinder", "a < b", "1", false, "for a reason"}};
    const std::string html = index_html({result}, {}, false);
    const auto has = [&](const std::string& text) { return html.find(text) != std::string::npos; };
    CHECK(has("Figure 9. "));
    CHECK(has("wavy-cylinder-curves.svg"));
    CHECK(has("smooth wavy-cylinder-input.ply out.ply --laplacian ptackova-velho --time-step 0.05 --steps 5 "
              "--labels wavy-cylinder-cut.txt --plain --conditions schwarz"));
    CHECK(has("a &lt; b"));
    CHECK(has("does not hold"));
    CHECK(has("for a reason"));
    CHECK_FALSE(has("wavy-cylinder.html"));
    CHECK_FALSE(has("the authors'</th>"));
    CHECK(index_html({result}, {}, true).find("wavy-cylinder.html") != std::string::npos);
    const Experiment schwarz = small("schwarz");
    CHECK(index_html({{.experiment = &schwarz, .table = run(schwarz), .claims = {}}}, {}, false)
              .find("<figcaption>the two sub-meshes and their overlap<") != std::string::npos);
    const Experiment texture = small("texture");
    CHECK(index_html({{.experiment = &texture, .table = run(texture), .claims = {}}}, {}, false)
              .find("<figcaption>the two sub-meshes<") != std::string::npos);
    CHECK_FALSE(has("Still to come"));
    CHECK_FALSE(has("<strong>"));
    CHECK(index_html({result}, {}, true, {}, "a < b").find("<strong>a &lt; b</strong>") != std::string::npos);
    CHECK(index_html({result}, {}, false, "texture, subdomains").find("Still to come") != std::string::npos);
    result.table.steps = 1;
    std::erase_if(result.table.rows, [](const Row& row) { return row.step > 1; });
    CHECK(index_html({result}, {}, false).find("-curves.svg") == std::string::npos);
    result.table.is_theirs = true;
    const std::string theirs = index_html({result}, {}, true);
    CHECK(theirs.find("0.011 / 0.2<") != std::string::npos);
    CHECK(theirs.find("0.201 / –<") != std::string::npos);
    CHECK(theirs.find(std::string(experiment.difference)) != std::string::npos);
}

TEST_CASE("every picture of a figure is of one of its flows")
{
    for (const Experiment& experiment : experiments())
        for (const auto& pictures : experiment.pictures)
            for (const std::string& title : pictures) {
                CAPTURE(title);
                const bool is_flow = std::any_of(experiment.variants.begin(), experiment.variants.end(),
                                                 [&](const Variant& variant) { return title_of(variant) == title; });
                CHECK((is_flow || title == picture_of::input || title == picture_of::cut || title == picture_of::part));
            }
}
