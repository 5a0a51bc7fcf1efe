#include <algorithm>
#include <numeric>
#include <random>

#include <doctest/doctest.h>

#include "engine/memory/factor_window.h"
#include "engine/steppers/sweep_order.h"
#include "partition/cut/coloring.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

namespace {

/// A sweep in which any task that need not wait may be next.
class SimulatedSweep {
  public:
    SimulatedSweep(const SweepPlan& plan, const FactorWindow& window)
        : plan_(&plan)
        , window_(&window)
        , place_(window.order.size())
        , factorised_(window.order.size(), 0)
        , solved_(window.order.size(), 0)
    {
        for (std::size_t i = 0; i < place_.size(); ++i)
            place_[window.order[i]] = static_cast<Index>(i);
    }

    /// @returns whether every sub-mesh was solved.
    bool run(std::uint32_t seed)
    {
        std::mt19937 random(seed);
        Index n_live = 0;
        for (std::vector<Index> ready = ready_tasks(); !ready.empty(); ready = ready_tasks()) {
            const Index task = ready[random() % ready.size()];
            const auto n = static_cast<Index>(place_.size());
            (task < n ? factorised_[task] : solved_[task - n]) = 1;
            n_live += task < n ? 1 : -1;
            CHECK(n_live <= window_->size);
        }
        return std::all_of(solved_.begin(), solved_.end(), [](char done) { return done != 0; });
    }

  private:
    /// Factorising s is task s, solving it task #sub-meshes + s.
    [[nodiscard]] std::vector<Index> ready_tasks() const
    {
        std::vector<Index> tasks;
        const auto n = static_cast<Index>(place_.size());
        for (Index s = 0; s < n; ++s) {
            if (factorised_[s] == 0 && has_room(s))
                tasks.push_back(s);
            if (factorised_[s] != 0 && solved_[s] == 0 && has_all_it_takes(s))
                tasks.push_back(n + s);
        }
        return tasks;
    }

    [[nodiscard]] bool has_room(Index s) const
    {
        const Index before = place_[s] - window_->size;
        return before < 0 || solved_[window_->order[before]] != 0;
    }

    [[nodiscard]] bool has_all_it_takes(Index s) const
    {
        const auto is_there = [](const std::vector<char>& done) {
            return [&done](const Transfer& transfer) { return done[transfer.from] != 0; };
        };
        const auto solved_or_later = [&](const Transfer& transfer) {
            return plan_->rank[transfer.from] > plan_->rank[s] || solved_[transfer.from] != 0;
        };
        const auto all = [](const std::vector<Transfer>& transfers, const auto& holds) {
            return std::all_of(transfers.begin(), transfers.end(), holds);
        };
        return all(plan_->traces[s], is_there(solved_)) && all(plan_->copies[s], solved_or_later) &&
               all(plan_->predictions[s], is_there(factorised_));
    }

    const SweepPlan* plan_;
    const FactorWindow* window_;
    std::vector<Index> place_;
    std::vector<char> factorised_;
    std::vector<char> solved_;
};

/// Whether a sweep comes to its end whatever runs first.
bool always_ends(const SweepPlan& plan, const FactorWindow& window)
{
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U})
        if (!SimulatedSweep(plan, window).run(seed))
            return false;
    return true;
}

std::vector<Index> in_order(std::size_t n)
{
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    return order;
}

std::vector<SweepPlan> plans_for(const Decomposition& decomposition)
{
    const std::vector<Index> by_color = color(decomposition.adjacency);
    const std::vector<Index> one_by_one = in_order(by_color.size());
    return {plan_sweep(decomposition, by_color), plan_sweep(decomposition, reversed(by_color)),
            plan_sweep(decomposition, one_by_one), plan_mutual_sweep(decomposition, by_color),
            plan_mutual_sweep(decomposition, reversed(by_color))};
}

}  // namespace

TEST_CASE("with the least window no sweep waits for itself, with one place less it does")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        std::vector<Index> shuffled = in_order(decomposition.sub_meshes.size());
        std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(7));
        for (const SweepPlan& plan : plans_for(decomposition))
            for (const auto& order : {reverse_cuthill_mckee(decomposition.adjacency), shuffled}) {
                const Index least = least_window(plan, order);
                CHECK(always_ends(plan, {order, least}));
                CHECK_FALSE(always_ends(plan, {order, least - 1}));
            }
    }
}

TEST_CASE("sub-meshes that take nothing from each other need one factor at a time")
{
    SweepPlan plan = empty_plan({0, 1, 2});
    CHECK(least_window(plan, {2, 0, 1}) == 1);
    plan.traces[2] = {{0, 2, {}, {}}};
    CHECK(least_window(plan, {0, 1, 2}) == 1);
    CHECK(least_window(plan, {2, 1, 0}) == 3);
}
