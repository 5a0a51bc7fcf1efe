#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/interface/interface_sums.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

namespace {

/// One of several ranks, in one thread: what they give is heard once all have said it.
class RankInTurn final : public InterfaceRanks {
  public:
    struct NotAllHaveSpoken {};

    RankInTurn(Index own_rank, const std::vector<Index>& holders, Numbers& said)
        : InterfaceRanks(own_rank, holders, {})
        , said_(&said)
    {
    }

    Numbers gather(const std::vector<double>& own) override
    {
        if (is_second_)
            return *said_;
        is_second_ = true;
        (*said_)[own_rank()] = own;
        throw NotAllHaveSpoken();
    }
    Numbers exchange(std::span<const Index>, const Numbers&) override { return {}; }

  private:
    Numbers* said_;
    bool is_second_ = false;
};

/// What each of three ranks finds, and how many rows they have told each other.
struct Found {
    std::vector<std::vector<double>> sums;
    std::size_t n_told = 0;
};

Found add_up_together(const std::vector<double>& rows, const std::vector<Index>& holders, std::size_t width)
{
    Found found;
    InterfaceRanks::Numbers said(3);
    std::vector<std::unique_ptr<RankInTurn>> ranks;
    for (Index self = 0; self < 3; ++self) {
        ranks.push_back(std::make_unique<RankInTurn>(self, holders, said));
        std::vector<double> used = rows;
        CHECK_THROWS_AS(SumTree(*ranks.back()).add_up(used, width), RankInTurn::NotAllHaveSpoken);
        found.n_told += said[self].size() / width;
    }
    for (const auto& rank : ranks) {
        // What others have is not known.
        std::vector<double> used(rows.size(), 1e9);
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (holders[i / width] == rank->own_rank())
                used[i] = rows[i];
        found.sums.push_back(SumTree(*rank).add_up(used, width));
    }
    return found;
}

}  // namespace

TEST_CASE("rows are added along a tree of their numbers, whoever has them")
{
    RandomNumbers random(3);
    for (const std::size_t n : {1, 2, 3, 5, 6, 7, 8}) {
        CAPTURE(n);
        std::vector<double> rows;
        for (std::size_t i = 0; i < 2 * n; ++i)
            rows.push_back(random.symmetric());
        const auto a = [&](std::size_t i) { return i < n ? rows[2 * i + 1] : 0.0; };
        const double expected = ((a(0) + a(1)) + (a(2) + a(3))) + ((a(4) + a(5)) + (a(6) + a(7)));
        OneRank all(static_cast<Index>(n));
        std::vector<double> used = rows;
        CHECK(SumTree(all).add_up(used, 2)[1] == expected);
        for (Index shift = 0; shift < 3; ++shift) {
            std::vector<Index> holders;
            for (std::size_t i = 0; i < n; ++i)
                holders.push_back(static_cast<Index>(i * 5 / 3 + usize(shift)) % 3);
            for (const auto& sums : add_up_together(rows, holders, 2).sums)
                CHECK(sums[1] == expected);
        }
    }
    // Of a range, only few sums are told.
    std::vector<Index> ranges(64, 0);
    std::fill(ranges.begin() + 21, ranges.end(), 2);
    CHECK(add_up_together(std::vector<double>(64, 1.0), ranges, 1).n_told < 10);
}

TEST_CASE("inner products count every vertex of the interface once")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const InterfaceCopies copies(test::decompose(cut));
        OneRank all(copies.n_sub_meshes());
        InterfaceSums sums(copies, all);
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
