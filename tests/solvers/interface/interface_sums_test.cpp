#include <vector>

#include <doctest/doctest.h>

#include "samples/common/meshes/random_numbers.h"
#include "solvers/interface/interface_sums.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

TEST_CASE("rows are added along a tree of their numbers")
{
    RandomNumbers random(3);
    for (const std::size_t n : {1, 2, 3, 5, 6, 7, 8}) {
        CAPTURE(n);
        std::vector<double> rows;
        for (std::size_t i = 0; i < 2 * n; ++i)
            rows.push_back(random.symmetric());
        const auto a = [&](std::size_t i) { return i < n ? rows[2 * i + 1] : 0.0; };
        const double expected = ((a(0) + a(1)) + (a(2) + a(3))) + ((a(4) + a(5)) + (a(6) + a(7)));
        std::vector<double> sums = rows;
        add_along_tree(sums, 2);
        CHECK(sums[1] == expected);
    }
}

TEST_CASE("inner products count every vertex of the interface once")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const InterfaceCopies copies(test::decompose(cut));
        InterfaceSums sums(copies);
        Points a(copies.n_vertices(), 3);
        Points b(copies.n_vertices(), 3);
        for (Index v = 0; v < copies.n_vertices(); ++v) {
            a.row(v) = Point(v, 1.0, -v);
            b.row(v) = Point(1.0, 2.0, v);
        }
        const auto products = sums.products({{a, b}, {b, b}}, run_serially);
        // Of whole numbers, in whatever order.
        CHECK(products[0] == Point(a.cwiseProduct(b).colwise().sum()));
        CHECK(products[1] == Point(b.cwiseProduct(b).colwise().sum()));
    }
}
