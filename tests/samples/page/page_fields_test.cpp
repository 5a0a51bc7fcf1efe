#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "samples/page/page_fields.h"
#include "samples/page/page_html.h"
#include "samples/page/page_template.h"
#include "tests/samples/page/inflated.h"
#include "tests/support/relative.h"
#include "tests/support/skipped.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

/// What a page makes of packed values of a field.
std::vector<double> shown_values(const PageField& field, const PackedValues& values)
{
    std::vector<double> shown;
    for (const std::uint16_t number : test::unpacked<std::uint16_t>(values.data, 1)) {
        const double root = number / 65534.0;
        shown.push_back(number == 65535 ? no_data
                                        : field.least + root * root * values.largest * (field.most - field.least));
    }
    return shown;
}

void check_shown(const PageField& field, const PackedValues& values, const Eigen::VectorXd& expected)
{
    const std::vector<double> shown = shown_values(field, values);
    REQUIRE(std::ssize(shown) == expected.size());
    for (Eigen::Index v = 0; v < expected.size(); ++v) {
        const double value = shown[static_cast<std::size_t>(v)];
        CHECK(std::isnan(value) == std::isnan(expected[v]));
        if (!std::isnan(value))
            CHECK(std::abs(value - expected[v]) <= 1e-4 * (field.most - field.least));
    }
}

}  // namespace

TEST_CASE("each field has its own values, before and after on one scale, and gaps where there are no data")
{
    Eigen::MatrixXd before(4, 2);
    before << -3.0, 100.0, 5.0, no_data, 1.0, 250.0, 0.0, 120.0;
    Eigen::MatrixXd after = 0.5 * before;
    after(1, 1) = 90.0;  // filled
    const std::vector<PageField> fields = pack_fields({"a", "b"}, before, after);
    REQUIRE(fields.size() == 2);
    CHECK(fields[0].least == -3.0);
    CHECK(fields[0].most == 5.0);
    CHECK_FALSE(fields[0].has_gaps);
    CHECK(fields[1].least == 50.0);
    CHECK(fields[1].most == 250.0);
    CHECK(fields[1].has_gaps);
    for (std::size_t c = 0; c < 2; ++c) {
        CHECK_FALSE(fields[c].is_colour);
        check_shown(fields[c], fields[c].before, before.col(static_cast<Eigen::Index>(c)));
        check_shown(fields[c], fields[c].after, after.col(static_cast<Eigen::Index>(c)));
    }
}

TEST_CASE("red, green and blue are one field, in whatever order, and grey without data")
{
    Eigen::MatrixXd before(3, 4);  // blue, quality, red, green
    before << 255.0, 7.0, 0.0, 51.0, 102.0, 8.0, 255.0, 0.0, 3.0, 9.0, no_data, 1.0;
    const Eigen::MatrixXd after = before.colwise().reverse();
    const std::vector<PageField> fields = pack_fields({"blue", "quality", "red", "green"}, before, after);
    REQUIRE(fields.size() == 2);
    CHECK(fields[0].is_colour);
    CHECK(fields[0].has_gaps);
    CHECK(test::inflated(fields[0].before.data) == std::vector<std::uint8_t>{0, 51, 255, 255, 0, 102, 128, 128, 128});
    CHECK(test::inflated(fields[0].after.data) == std::vector<std::uint8_t>{128, 128, 128, 255, 0, 102, 0, 51, 255});
    CHECK(fields[1].name == "quality");
    check_shown(fields[1], fields[1].before, before.col(1));
    // Parts of 1 stay, and two of the three are no colour.
    const std::vector<PageField> parts =
        pack_fields({"red", "green", "blue"}, Eigen::MatrixXd(0, 0), Eigen::RowVector3d(0.2, 0.4, 1.0));
    CHECK(test::inflated(parts[0].after.data) == std::vector<std::uint8_t>{51, 102, 255});
    // More than full brightness is left by some filters.
    const std::vector<PageField> overshooting =
        pack_fields({"red", "green", "blue"}, Eigen::RowVector3d(0.0, 0.4, 1.0), Eigen::RowVector3d(-0.1, 0.4, 1.1));
    CHECK(test::inflated(overshooting[0].before.data) == std::vector<std::uint8_t>{0, 102, 255});
    CHECK(test::inflated(overshooting[0].after.data) == std::vector<std::uint8_t>{0, 102, 255});
    CHECK(pack_fields({"red", "green"}, before.leftCols(2), after.leftCols(2)).size() == 2);
}

TEST_CASE("98 % of the data have their own range; fields of one value, of none, and of huge ones have pictures, too")
{
    Eigen::MatrixXd values(1000, 4);
    for (Eigen::Index v = 0; v < 1000; ++v)
        values.row(v) << static_cast<double>(v), 4.0, no_data, (v == 0 ? -1.0 : 1.0) * 1.7e308;
    values(7, 0) = 1e9;
    const std::vector<PageField> fields = pack_fields({"a", "b", "c", "d"}, Eigen::MatrixXd(0, 0), values);
    CHECK(fields[0].most == 1e9);
    CHECK(fields[0].percentile_1 == test::relative(11.0, 0.01));
    CHECK(fields[0].percentile_99 == test::relative(990.0, 0.01));
    CHECK(fields[0].before.data.empty());
    CHECK(fields[1].least == 4.0);
    check_shown(fields[1], fields[1].after, values.col(1));
    CHECK(fields[1].has_data);
    CHECK_FALSE(fields[2].has_data);
    CHECK(fields[2].most == 0.0);
    check_shown(fields[2], fields[2].after, values.col(2));
    const auto huge = test::unpacked<std::uint16_t>(fields[3].after.data, 1);
    CHECK(huge[0] == 0);
    CHECK(huge[1] == 65534);
}

TEST_CASE("vertices without faces are not in the box of a page")
{
    PolygonMesh mesh = test::quad_torus(4, 3);
    const PackedPoints expected = pack_points(mesh.vertices);
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.bottomRows(1).setConstant(1e6);
    const PackedPoints packed = PageMesh(mesh).pack(mesh.vertices);
    CHECK(packed.lower == expected.lower);
    CHECK(packed.upper == expected.upper);
    const auto numbers = test::unpacked<std::uint16_t>(packed.data, 3);
    CHECK(numbers.size() == static_cast<std::size_t>(mesh.vertices.size()));
    // Without faces there is nothing else to look at.
    PolygonMesh points;
    points.vertices = mesh.vertices;
    const PackedPoints alone = PageMesh(points).pack(mesh.vertices);
    CHECK(alone.upper == Eigen::RowVector3d::Constant(1e6));
}

TEST_CASE("a page of fields has the states before and after, of distances only one")
{
    if (page_template().empty())
        return test::skip("there is no npm");
    const PageMesh mesh(test::quad_torus(4, 3));
    const Eigen::MatrixXd before = Eigen::VectorXd::LinSpaced(12, 0.0, 11.0);
    const Eigen::MatrixXd after = Eigen::VectorXd::LinSpaced(12, 3.0, 4.0);
    for (const bool are_distances : {false, true}) {
        const PageFields fields{.fields =
                                    pack_fields({"</script>"}, are_distances ? Eigen::MatrixXd(0, 0) : before, after),
                                .are_distances = are_distances,
                                .steps = 10,
                                .report_json = "{}"};
        const std::string html = page_html("torus", mesh, fields);
        const std::string mark = "id=\"facts\">";
        const auto begin = html.find(mark) + mark.size();
        const auto facts = nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
        const auto& flow = facts["flows"][0];
        CHECK(flow["fields"][0]["name"] == "</script>");
        REQUIRE(flow["states"].size() == (are_distances ? 1 : 2));
        CHECK(flow["states"].back()["step"] == 10);
        for (std::size_t k = 0; k < flow["states"].size(); ++k) {
            const auto& shown = flow["states"][k]["fields"][0];
            const bool is_after = are_distances || k == 1;
            const std::string block = "id=\"block-" + std::to_string(shown["block"].get<int>()) + "\">";
            const auto place = html.find(block) + block.size();
            const PackedValues values{.largest = shown["largest"].get<double>(),
                                      .data = html.substr(place, html.find("</script>", place) - place)};
            check_shown(fields.fields[0], values, is_after ? after : before);
        }
    }
}
