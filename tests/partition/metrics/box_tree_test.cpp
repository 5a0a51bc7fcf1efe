#include <vector>

#include <doctest/doctest.h>

#include "partition/metrics/box_tree.h"
#include "samples/meshes/random_numbers.h"

using namespace seamflow;

namespace {

Box random_box(double size, RandomNumbers& random)
{
    Box box;
    const Point middle(random.symmetric(), random.symmetric(), random.symmetric());
    for (int k = 0; k < 3; ++k)
        box.add(Point(middle + size * Point(random.symmetric(), random.symmetric(), random.symmetric())));
    return box;
}

}  // namespace

TEST_CASE("a tree finds the boxes that meet another, each once and ascending")
{
    RandomNumbers random(1);
    for (const int n : {0, 1, 2, 3, 5, 64, 100, 257}) {
        std::vector<Box> boxes;
        for (int i = 0; i < n; ++i)
            boxes.push_back(random_box(0.2, random));
        const BoxTree tree(boxes);
        CHECK(tree.size() == n);
        for (const Index first : {0, 1, n / 2, n}) {
            const Box box = random_box(0.4, random);
            std::vector<Index> expected;
            for (Index i = first; i < n; ++i)
                if (boxes[i].meets(box))
                    expected.push_back(i);
            std::vector<Index> found;
            tree.for_each_meeting(box, first, [&](Index i) { found.push_back(i); });
            CHECK(found == expected);
        }
    }
}

TEST_CASE("boxes meet where their borders touch; an empty one meets nothing")
{
    Box box;
    CHECK_FALSE(box.meets(box));
    box.add(Point(1, 1, 1));
    CHECK(box.meets(box));
    Box other;
    other.add(Point(1, 0, 0));
    other.add(Point(2, 1, 2));
    CHECK(box.meets(other));
    CHECK_FALSE(Box{}.meets(other));
    Box beyond;
    beyond.add(Point(1, 1, 2.5));
    CHECK_FALSE(beyond.meets(other));
    CHECK_FALSE(other.meets(beyond));
}
