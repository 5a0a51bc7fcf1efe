#include <doctest/doctest.h>

#include "partition/formats/obj.h"

using namespace seamflow;

namespace {

std::vector<Index> corners_of(const IndexLists& normals, Index normal)
{
    const auto corners = normals[normal];
    return {corners.begin(), corners.end()};
}

}  // namespace

TEST_CASE("the corners that name each normal, absolutely or counted back, before or after it")
{
    const IndexLists normals =
        corners_of_obj_normals("a.obj", "f 1//3 2/1/1 3\nvn 0 0 1\nvn 0 0 1\nf 1//-1 2/5/-2 \\\n3//+1\n"
                                        "vn 0 0 1\nfo 1/1/1 2/1 3//\n");
    REQUIRE(normals.size() == 3);
    CHECK(corners_of(normals, 0) == std::vector<Index>{1, 4, 5, 6});
    CHECK(corners_of(normals, 1) == std::vector<Index>{3});
    CHECK(corners_of(normals, 2) == std::vector<Index>{0});
}

TEST_CASE("normals that there are not are named by no corner")
{
    const IndexLists normals = corners_of_obj_normals("a.obj", "vn 0 0 1\nf 1//0 2//2 3//-2 4//99999999999 5//1\n");
    REQUIRE(normals.size() == 1);
    CHECK(corners_of(normals, 0) == std::vector<Index>{4});
    CHECK(corners_of_obj_normals("a.obj", "f 1//1 2//1 3//1\n").size() == 0);
}

TEST_CASE("a corner that repeats the one before it takes its normal with it")
{
    const IndexLists normals =
        corners_of_obj_normals("a.obj", "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 1//1 1//2 2//2 3//3\nf 4//3 5//1 6//2\n");
    REQUIRE(normals.size() == 3);
    CHECK(corners_of(normals, 0) == std::vector<Index>{0, 4});
    CHECK(corners_of(normals, 1) == std::vector<Index>{1, 5});
    CHECK(corners_of(normals, 2) == std::vector<Index>{2, 3});
}
