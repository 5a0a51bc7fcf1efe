#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/figures/curves.h"
#include "samples/figures/drawing.h"
#include "samples/figures/experiments.h"
#include "samples/figures/index_page.h"
#include "tests/samples/figures/made_up.h"
#include "tests/support/relative.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("pictures show what is nearest, in its colour, and nothing where there is nothing")
{
    // A large square below a small one, seen aslant from above.
    PolygonMesh mesh;
    mesh.vertices.resize(6, 3);
    mesh.vertices << -1, -1, 0, 1, -1, 0, 0, 1, 0, -0.2, -0.4, 0.1, 0.2, -0.4, 0.1, 0, 0, 0.1;
    mesh.add_face(std::array<Index, 3>{3, 4, 5});
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    const Viewpoint viewpoint(mesh);
    const std::vector<double> values(6, 0.5);
    double largest = 0.0;
    const auto paint = [&](Index triangle, double value) {
        largest = std::max(largest, value);
        return triangle == 0 ? Colour{200, 0, 0} : Colour{0, 0, 200};
    };
    const Image image = draw(mesh, values, paint, viewpoint);
    CHECK(largest == relative(0.5, 1e-5));
    CHECK(image.pixels.size() == 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const auto pixel_at = [&](const Eigen::RowVector3d& point) {
        const Points seen = viewpoint.seen(point);
        const auto x = static_cast<std::size_t>(seen(0, 0));
        const auto y = static_cast<std::size_t>(seen(0, 1));
        return &image.pixels[4 * (y * static_cast<std::size_t>(image.width) + x)];
    };
    const auto* upper = pixel_at({0.0, -0.25, 0.1});
    CHECK(upper[0] > 100);
    CHECK(upper[2] == 0);
    CHECK(upper[3] == 255);
    const auto* lower = pixel_at({0.5, -0.8, 0.0});
    CHECK(lower[0] == 0);
    CHECK(lower[2] > 100);
    CHECK(image.pixels[3] == 0);
    // A vertex without faces changes nothing.
    PolygonMesh stray = mesh;
    stray.vertices.conservativeResize(7, 3);
    stray.vertices.row(6) << 1000, 0, 500;
    CHECK(Viewpoint(stray).seen(mesh.vertices) == viewpoint.seen(mesh.vertices));
    // Triangles much larger than the picture, and beyond all numbers.
    mesh.vertices.row(0) << -1e9, -1e9, 0;
    CHECK(draw(mesh, values, paint, viewpoint).pixels.size() == image.pixels.size());
    mesh.vertices.row(0) << -1e200, -1e200, 0;
    CHECK_NOTHROW(draw(mesh, values, paint, viewpoint));
    mesh.vertices(0, 0) = std::nan("");
    CHECK_NOTHROW(draw(mesh, values, paint, viewpoint));
}

TEST_CASE("pictures are written as PNG")
{
    const test::TemporaryDirectory folder;
    write_png(folder / "a.png", {.width = 2, .height = 1, .pixels = {255, 0, 0, 255, 0, 0, 0, 0}});
    CHECK(test::content_of(folder / "a.png").starts_with("\x89PNG\r\n\x1a\n"));
    CHECK_THROWS_AS(write_png(folder / "none" / "a.png", {.width = 1, .height = 1, .pixels = {0, 0, 0, 0}}),
                    OutputError);
}

TEST_CASE("curves have a panel for each decomposed flow, and the authors' numbers on their mesh")
{
    const Experiment experiment = small("wavy-cylinder");
    Table table = run(experiment);
    const std::string curves = curves_svg(table, experiment);
    const auto count = [](const std::string& text, const std::string& what) {
        std::size_t found = 0;
        for (std::size_t place = text.find(what); place != std::string::npos; place = text.find(what, place + 1))
            ++found;
        return found;
    };
    CHECK(count(curves, "<g ") == 4);
    CHECK(count(curves, "<title>V_mean</title>") == 4);
    CHECK(count(curves, "<title>H_max</title>") == 4);
    CHECK(count(curves, "nan") == 0);
    CHECK(count(curves, "#b02a50") == 0);
    table.is_theirs = true;
    // However far they are from ours.
    Experiment far = experiment;
    far.theirs[0].v_max = 5e4;
    CHECK(curves_svg(table, far).find(">1e5<") != std::string::npos);
    // Of Schwarz the largest distances are not known. One is in the legend.
    CHECK(count(curves_svg(table, experiment), "#b02a50") == 7);
    // A flow that ended early, and one that has nothing to show.
    table.rows[12].v.mean = std::nan("");
    CHECK(count(curves_svg(table, experiment), "nan") == 0);
    table.steps = 1;
    CHECK(curves_svg(table, experiment).empty());
}

TEST_CASE("curves over the number of sub-meshes and over their width have a panel for each way of taking steps")
{
    Experiment many = with_many_sub_meshes(small("teaser", 1500));
    std::erase_if(many.variants, [](const Variant& variant) { return variant.laplacian != Laplacian::Fujiwara; });
    many.steps = 1;
    Table table = run(many);
    CHECK(table.area > 0.0);
    const auto count = [](const std::string& text, const std::string& what) {
        std::size_t found = 0;
        for (std::size_t place = text.find(what); place != std::string::npos; place = text.find(what, place + 1))
            ++found;
        return found;
    };
    for (const std::string& curves : {curves_of_many({table}), curves_over_width({table})}) {
        CHECK(count(curves, "<g ") == 2);
        CHECK(count(curves, "the paper's method") == 1);
        CHECK(count(curves, "the library's defaults") == 1);
        // Five numbers of sub-meshes.
        CHECK(count(curves, "<title>Δ_F, V_mean</title>") == 2);
        CHECK(count(curves, "<title>Δ_F, V_max</title>") == 2);
        const auto path = curves.find("<path d=\"M");
        REQUIRE(path != std::string::npos);
        CHECK(std::ranges::count(curves.substr(path, curves.find("\" fill", path) - path), 'L') == 4);
        CHECK(count(curves, "nan") == 0);
    }
    // What ended early leaves a gap.
    std::erase_if(table.rows, [](const Row& row) { return row.subdomains == 8; });
    CHECK(count(curves_of_many({table}), "nan") == 0);
    CHECK(curves_of_many({table}) != curves_of_many({run(many)}));
}

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
    CHECK_FALSE(has("Still to come"));
    CHECK(index_html({result}, {}, false, "texture, subdomains").find("Still to come") != std::string::npos);
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
