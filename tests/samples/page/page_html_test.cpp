#include <map>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "samples/page/page_html.h"
#include "samples/page/page_template.h"
#include "samples/page/shown_steps.h"
#include "samples/report/report_json.h"
#include "tests/samples/page/inflated.h"
#include "tests/support/relative.h"
#include "tests/support/skipped.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using Json = nlohmann::json;

namespace {

/// A flow of three steps on a small torus, as a page has it.
PageFlow make_flow(bool undecomposed, const std::string& input = "torus.obj")
{
    PolygonMesh mesh = test::quad_torus(12, 8);
    FlowOptions options;
    options.time_step = 0.01;
    options.steps = 3;
    options.cut.subdomains = 4;
    options.report.reference = undecomposed;
    options.accuracy.approach = Approach::Sweep;
    PageFlow flow(std::make_shared<const PageMesh>(mesh), "flow", options.laplacian, options.steps, undecomposed);
    const FlowReport report = mean_curvature_flow(mesh, options, [&](const StepState& state) {
        flow.add_step(state.step, state.positions, state.reference_positions);
    });
    RunRecord run;
    run.input = input;
    complete_record(run, report);
    flow.finish(report, smooth_report_json(run, options, report));
    return flow;
}

/// What stands between two marks.
std::string between(const std::string& text, const std::string& first, const std::string& last)
{
    const auto begin = text.find(first);
    REQUIRE(begin != std::string::npos);
    const auto end = text.find(last, begin + first.size());
    return text.substr(begin + first.size(), end - begin - first.size());
}

Json facts_of(const std::string& html)
{
    return Json::parse(between(html, "<script type=\"application/json\" id=\"facts\">", "</script>"));
}

std::string block_of(const std::string& html, const Json& number)
{
    return between(html, "id=\"block-" + std::to_string(number.get<int>()) + "\">", "</script>");
}

}  // namespace

TEST_CASE("a flow has the input and all its steps, beside the undecomposed ones where they are known")
{
    for (const bool undecomposed : {false, true}) {
        const PageFlow flow = make_flow(undecomposed);
        REQUIRE(flow.states().size() == 4);
        CHECK(flow.states()[0].distance.largest == 0.0);
        CHECK_FALSE(flow.states()[0].undecomposed);
        for (std::size_t k = 1; k < 4; ++k) {
            const PageState& state = flow.states()[k];
            CHECK(state.step == static_cast<int>(k));
            CHECK(state.undecomposed.has_value() == undecomposed);
            CHECK(state.distance.largest > 0.0);
            CHECK(state.surface.positions.data != flow.states()[k - 1].surface.positions.data);
        }
        const Json report = Json::parse(flow.report_json());
        if (undecomposed)
            CHECK(flow.states()[3].distance.largest == test::relative(report["steps"][2]["v_max"].get<double>(), 1e-5));
        CHECK(flow.states()[3].surface.curvature.largest ==
              test::relative(report["steps"][2]["max_mean_curvature_after"].get<double>(), 1e-5));
    }
}

TEST_CASE("a page is built where npm is, and elsewhere says what it takes")
{
    if (!page_template().empty()) {
        CHECK_NOTHROW(require_page());
        const PageFlow flow = make_flow(false);
        CHECK(page_html("torus", {&flow, 1}).find("<title>torus</title>") != std::string::npos);
        return;
    }
    CHECK_THROWS_WITH_AS(require_page(), doctest::Contains("apt-get install nodejs npm"), OptionError);
    const PageFlow flow = make_flow(false);
    CHECK_THROWS_AS(page_html("torus", {&flow, 1}), OptionError);
}

TEST_CASE("a page holds its data, and they unpack")
{
    if (page_template().empty())
        return test::skip("there is no npm");
    const PageFlow flow = make_flow(true);
    const std::string html = page_html("torus.obj", {&flow, 1});
    const Json facts = facts_of(html);
    CHECK(facts["title"] == "torus.obj");
    CHECK(facts["mesh"]["faces"] == 96);
    CHECK(facts["mesh"]["triangles"] == 192);
    const auto corners = test::unpacked<std::uint32_t>(block_of(html, facts["mesh"]["corners"]), 3);
    CHECK(corners.size() == 3 * 192);
    const auto labels = test::unpacked<std::uint32_t>(block_of(html, facts["flows"][0]["labels"]), 1);
    CHECK(std::vector<Index>(labels.begin(), labels.end()) == flow.labels());
    const Json& states = facts["flows"][0]["states"];
    REQUIRE(states.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(test::unpacked<std::uint16_t>(block_of(html, states[k]["surface"]["positions"]["block"]), 3).size() ==
              3 * 96);
        CHECK(states[k].contains("undecomposed") == (k > 0));
    }
    CHECK(facts["flows"][0]["report"]["steps"].size() == 3);
}

TEST_CASE("a page asks for nothing from anywhere, whatever it is called")
{
    if (page_template().empty())
        return test::skip("there is no npm");
    const std::string name = "</title></script><script>alert(1)</script><!-- & \"torus\" '\xff.obj";
    const PageFlow flow = make_flow(false, name);
    const std::string html = page_html(name, {&flow, 1});
    CHECK(html.find("alert(1)</script>") == std::string::npos);
    CHECK(html.find("<title>&lt;/title&gt;&lt;/script&gt;") != std::string::npos);
    CHECK(html.find("default-src 'none'") != std::string::npos);
    CHECK(html.find(" src=\"http") == std::string::npos);
    const Json facts = facts_of(html);
    const std::string title = facts["title"].get<std::string>();
    CHECK(title.starts_with("</title></script>"));
    CHECK(facts["flows"][0]["report"]["input"] == title);
}

TEST_CASE("numbers that are none do not get onto a page")
{
    if (page_template().empty())
        return test::skip("there is no npm");
    PageFlow flow(std::make_shared<const PageMesh>(test::quad_torus(4, 3)), "", Laplacian::Fujiwara, 1, true);
    const Points nowhere = Points::Zero(12, 3);
    flow.add_step(1, nowhere, &nowhere);
    FlowReport report;
    report.steps.emplace_back().seconds = std::nan("");
    flow.finish(report, smooth_report_json({}, {}, report));
    const std::string html = page_html("point", {&flow, 1});
    const Json facts = facts_of(html);
    const Json& distance = facts["flows"][0]["states"][1]["distance"];
    CHECK(distance["largest"] == 0.0);
    for (const std::uint16_t number : test::unpacked<std::uint16_t>(block_of(html, distance["block"]), 1))
        CHECK(number == 65535);
    CHECK(facts["flows"][0]["report"]["steps"][0]["seconds"].is_null());
}

TEST_CASE("meshes that no browser shows are refused before the work")
{
    PolygonMesh mesh;
    mesh.vertices = Points::Zero(3, 3);
    CHECK_NOTHROW(require_showable(mesh, "page.html"));
    mesh.face_offsets.resize(6'000'001, 0);
    CHECK_THROWS_WITH_AS(
        require_showable(mesh, "page.html"),
        "page.html: cannot be written: a browser shows at most 5000000 faces, and the mesh has 6000000", OutputError);
}
