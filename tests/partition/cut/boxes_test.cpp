#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/cut/boxes.h"

using namespace seamflow;

namespace {

Points random_points(Index n)
{
    std::mt19937 random(7);
    Points points(n, 3);
    for (Index i = 0; i < n; ++i)
        for (const Index axis : {0, 1, 2})
            points(i, axis) = static_cast<double>(random()) / 4294967296.0 * (axis + 1);
    return points;
}

}  // namespace

TEST_CASE("points are divided among boxes of about as many each, apart and each along its longest side")
{
    const Points points = random_points(20000);
    const IndexLists boxes = divide_into_boxes(points, 16, run_serially);
    REQUIRE(boxes.size() == 16);
    std::vector<Index> all = boxes.values;
    std::ranges::sort(all);
    std::vector<Index> expected(20000);
    std::iota(expected.begin(), expected.end(), 0);
    CHECK(all == expected);
    std::vector<Eigen::AlignedBox3d> extents(16);
    for (Index b = 0; b < 16; ++b) {
        CHECK(boxes[b].size() > 1000);
        CHECK(boxes[b].size() < 1600);
        for (const Index i : boxes[b])
            extents[b].extend(points.row(i).transpose());
        Index axis = 0;
        extents[b].sizes().maxCoeff(&axis);
        CHECK(std::ranges::is_sorted(boxes[b], {}, [&](Index i) { return points(i, axis); }));
    }
    for (Index b = 0; b < 16; ++b)
        for (Index c = 0; c < b; ++c)
            CHECK(extents[b].intersection(extents[c]).isEmpty());
    CHECK(divide_into_boxes(points, 16, run_in_parallel).values == boxes.values);
}

TEST_CASE("points at one place, few points and none are divided, too")
{
    const Points same = Points::Ones(1000, 3);
    const IndexLists boxes = divide_into_boxes(same, 4, run_serially);
    CHECK(boxes.values.size() == 1000);
    CHECK(std::ranges::is_sorted(boxes.values));
    CHECK(divide_into_boxes(random_points(3), 8, run_serially).values.size() == 3);
    CHECK(divide_into_boxes(Points(0, 3), 2, run_serially).size() == 2);
}
