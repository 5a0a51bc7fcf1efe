#include <algorithm>
#include <numeric>
#include <random>

#include <doctest/doctest.h>

#include "engine/sweep/factor_windows.h"
#include "engine/sweep/sweep_order.h"
#include "partition/cut/colouring.h"
#include "partition/cut/cut_into.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "samples/meshes/meshes.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

namespace {

Decomposition cut_up(const PolygonMesh& mesh, Index k)
{
    const Topology topology = make_topology(mesh);
    const Cut cut = cut_into(mesh, topology, k);
    return decompose(mesh, topology, cut.labels, cut.n_parts);
}

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
        return before < 0 || solved_[window_->freed[before]] != 0;
    }

    [[nodiscard]] bool has_all_it_takes(Index s) const
    {
        const auto is_there = [](const std::vector<char>& done) {
            return [&done](const Transfer& transfer) { return done[transfer.from] != 0; };
        };
        const auto solved_or_later = [&](const Transfer& transfer) {
            return plan_->stage[transfer.from] > plan_->stage[s] || solved_[transfer.from] != 0;
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
    const std::vector<Index> by_colour = colour(decomposition.adjacency);
    const std::vector<Index> one_by_one = in_order(by_colour.size());
    return {plan_sweep(decomposition, by_colour), plan_sweep(decomposition, reversed(by_colour)),
            plan_sweep(decomposition, one_by_one), plan_mutual_sweep(decomposition, by_colour),
            plan_mutual_sweep(decomposition, reversed(by_colour))};
}

}  // namespace

TEST_CASE("adjacent sub-meshes have different ranks, and ranks have no gaps")
{
    for (const Index k : {2, 3, 8, 20}) {
        const Decomposition decomposition = cut_up(make_triangles(3000), k);
        for (const bool solves_in_order_of_numbers : {false, true}) {
            const auto stage = assign_stages(decomposition.adjacency, solves_in_order_of_numbers,
                                             total_curvatures(decomposition, std::vector<double>(4000, 1.0)));
            std::vector<int> used(stage.size(), 0);
            for (std::size_t s = 0; s < stage.size(); ++s) {
                ++used[stage[s]];
                for (const Index t : decomposition.adjacency[s])
                    CHECK(stage[s] != stage[t]);
            }
            bool ended = false;
            for (const int count : used) {
                CHECK_FALSE((ended && count > 0));
                ended = ended || count == 0;
            }
        }
    }
}

TEST_CASE("with labels as colours the rank is the label")
{
    const auto stage = assign_stages(cut_up(make_quads(1000), 5).adjacency, true, std::vector<double>(5, 0.0));
    CHECK(stage == std::vector<Index>{0, 1, 2, 3, 4});
}

TEST_CASE("the colour with more curvature in the interior of its sub-meshes goes first")
{
    const PolygonMesh mesh = make_quads(1000);
    const Decomposition decomposition = cut_up(mesh, 2);
    for (const Index curved : {0, 1}) {
        std::vector<double> curvature(mesh.n_vertices(), 1e-3);
        const SubMesh& sub_mesh = decomposition.sub_meshes[curved];
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            curvature[sub_mesh.local_to_global[v]] = 1.0;
        const auto stage = assign_stages(decomposition.adjacency, false, total_curvatures(decomposition, curvature));
        CHECK(stage[curved] == 0);
        CHECK(stage[1 - curved] == 1);
    }
}

TEST_CASE("curvature on the interface and on the boundary does not count")
{
    const PolygonMesh mesh = make_quads(1000);
    const Decomposition decomposition = cut_up(mesh, 2);
    std::vector<double> curvature(mesh.n_vertices(), 1e-3);
    for (Index v = 0; v < decomposition.sub_meshes[1].n_vertices; ++v)
        if (decomposition.sub_meshes[1].fixed[v] != 0)
            curvature[decomposition.sub_meshes[1].local_to_global[v]] = 1e6;
    for (const Index v : decomposition.sub_meshes[1].interface.vertices)
        curvature[decomposition.sub_meshes[1].local_to_global[v]] = 1e6;
    const SubMesh& first = decomposition.sub_meshes[0];
    for (Index v = 0; v < first.n_vertices; ++v)
        if (first.fixed[v] == 0)
            curvature[first.local_to_global[v]] += 1e-3;
    CHECK(assign_stages(decomposition.adjacency, false, total_curvatures(decomposition, curvature)) ==
          std::vector<Index>{0, 1});
}

TEST_CASE("the reversed order turns first to last")
{
    CHECK(reversed({0, 2, 1, 0}) == std::vector<Index>{2, 0, 1, 2});
    CHECK(reversed({}).empty());
}

TEST_CASE("with the least window no sweep waits for itself, with one place less it does")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        std::vector<Index> shuffled = in_order(decomposition.sub_meshes.size());
        std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(7));
        for (const SweepPlan& plan : plans_for(decomposition))
            for (const auto& order : {order_by_need(plan, shuffled), shuffled}) {
                FactorWindow window = least_window(plan, order);
                CHECK(always_ends(plan, window));
                --window.size;
                CHECK_FALSE(always_ends(plan, window));
            }
    }
}

TEST_CASE("sub-meshes that take nothing from each other need one factor at a time")
{
    SweepPlan plan = empty_plan({0, 1, 2});
    CHECK(least_window(plan, {2, 0, 1}).size == 1);
    plan.traces[2] = {{0, 2, {}, {}}};
    CHECK(least_window(plan, {0, 1, 2}).size == 1);
    CHECK(least_window(plan, {2, 1, 0}).size == 2);
    CHECK(least_window(plan, order_by_need(plan, {2, 1, 0})).size == 1);
}
