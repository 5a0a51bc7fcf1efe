#include <algorithm>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
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

TEST_CASE("a tree finds the nearest box, and not much else on the way")
{
    RandomNumbers random(2);
    for (const int n : {1, 2, 3, 5, 64, 100, 257, 5000}) {
        std::vector<Box> boxes;
        std::vector<Point> centres;
        for (int i = 0; i < n; ++i) {
            boxes.push_back(random_box(0.01, random));
            centres.push_back(centre_of(boxes.back()));
        }
        std::vector<Box> sorted;
        for (const Index i : order_of_neighbours(centres))
            sorted.push_back(boxes[i]);
        const BoxTree tree(sorted);
        for (int i = 0; i < 10; ++i) {
            const Point p = random_box(0.0, random).low;
            double least = std::numeric_limits<double>::infinity();
            for (const Box& box : boxes)
                least = std::min(least, squared_distance(box, p));
            double bound = std::numeric_limits<double>::infinity();
            int n_visits = 0;
            tree.for_each_nearer(p, tree.root(), bound, [&](Index leaf) {
                bound = std::min(bound, squared_distance(tree.leaf(leaf), p));
                ++n_visits;
            });
            CHECK(bound == least);
            CHECK(n_visits <= 50);
        }
    }
}

TEST_CASE("neighbours are halved across the longest side, the same way on any number of threads")
{
    RandomNumbers random(3);
    for (const int n : {0, 1, 2, 3, 64, 65, 1000}) {
        std::vector<Point> points;
        for (int i = 0; i < n; ++i)
            points.emplace_back(random.symmetric(), 9.0 * random.symmetric(), random.symmetric());
        const std::vector<Index> order = order_of_neighbours(points);
        CHECK(order_of_neighbours(points, run_in_parallel) == order);
        std::vector<Index> numbers = order;
        std::ranges::sort(numbers);
        REQUIRE(std::ssize(numbers) == n);
        for (Index i = 0; i < n; ++i)
            CHECK(numbers[i] == i);
        const Index half = n > 512 ? 512 : n / 2;
        if (n == 64 || n == 1000)
            for (Index i = 0; i < half; ++i)
                CHECK(points[order[i]][1] <= points[order[half]][1]);
    }
}
