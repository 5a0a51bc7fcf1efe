#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "samples/page/packed_state.h"
#include "tests/samples/page/inflated.h"
#include "tests/support/relative.h"

using namespace seamflow;

TEST_CASE("positions are off by half a 65,535th of their box at most")
{
    Points positions = Points::Random(500, 3);
    positions.col(1) *= 1e-4;
    positions.col(2).setConstant(3.0);
    const PackedPoints points = pack_points(positions);
    const auto numbers = test::unpacked<std::uint16_t>(points.data, 3);
    REQUIRE(numbers.size() == 1500);
    const Eigen::RowVector3d extent = points.upper - points.lower;
    CHECK(extent.z() == 0.0);
    for (Eigen::Index v = 0; v < 500; ++v)
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const double part = numbers[static_cast<std::size_t>(3 * v + axis)] / 65535.0;
            CHECK(std::abs(points.lower[axis] + part * extent[axis] - positions(v, axis)) <=
                  extent[axis] * (0.5 / 65535.0 + 1e-9));
        }
}

TEST_CASE("the largest coordinates there are can be packed, and none at all")
{
    Points positions = Points::Zero(3, 3);
    positions(0, 0) = std::numeric_limits<double>::max();
    positions(1, 0) = -std::numeric_limits<double>::max();
    const auto numbers = test::unpacked<std::uint16_t>(pack_points(positions).data, 3);
    CHECK(numbers == std::vector<std::uint16_t>{65535, 0, 0, 0, 0, 0, 32768, 0, 0});
    CHECK(test::inflated(pack_points(Points(0, 3)).data).empty());
}

TEST_CASE("values keep three digits over a millionfold range, and tell what is not finite")
{
    std::vector<double> values = {0.0, 1e-6, 1e-4, 0.01, 0.5, 1.0};
    for (double& value : values)
        value *= 40.0;
    values.push_back(std::nan(""));
    values.push_back(std::numeric_limits<double>::infinity());
    const PackedValues packed_values = pack_values(values);
    CHECK(packed_values.largest == 40.0);
    const auto numbers = test::unpacked<std::uint16_t>(packed_values.data, 1);
    CHECK(numbers[0] == 0);
    for (std::size_t i = 1; i < 6; ++i) {
        const double root = numbers[i] / 65534.0;
        CHECK(root * root * packed_values.largest == test::relative(values[i], i == 1 ? 0.02 : 0.002));
    }
    CHECK(numbers[5] == 65534);
    CHECK(numbers[6] == 65535);
    CHECK(numbers[7] == 65535);
}

TEST_CASE("one large value among many does not stretch the scale of colours")
{
    std::vector<double> values(1000, 2.0);
    values[17] = 5000.0;
    CHECK(pack_values(values).percentile_99 == 2.0);
    CHECK(pack_values(values).largest == 5000.0);
    CHECK(pack_values(std::vector<double>{std::nan("")}).largest == 0.0);
    CHECK(pack_values({}).percentile_99 == 0.0);
}
