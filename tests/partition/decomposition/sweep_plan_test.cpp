#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "partition/cut/coloring.h"
#include "partition/decomposition/sweep_plan.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Ranks to try: by colour in both directions, and each sub-mesh on its own.
std::vector<std::vector<Index>> ranks_for(const Decomposition& decomposition)
{
    const std::vector<Index> by_color = color(decomposition.adjacency);
    std::vector<Index> backwards = by_color;
    for (Index& rank : backwards)
        rank = n_colors(by_color) - 1 - rank;
    std::vector<Index> one_by_one(by_color.size());
    std::iota(one_by_one.begin(), one_by_one.end(), 0);
    return {by_color, backwards, one_by_one};
}

/// Calls `check` for every cut mesh and several orders of its sub-meshes.
template <class Check>
void for_each_plan(Check&& check)
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const auto& rank : ranks_for(decomposition)) {
            const SweepPlan plan = plan_sweep(decomposition, rank);
            CHECK(plan.rank == rank);
            check(decomposition, plan);
        }
    }
}

/// The sub-mesh of the lowest rank among those at the i-th vertex of Γ of a sub-mesh.
Index first_at(const SubMesh& sub_mesh, Index i, const SweepPlan& plan)
{
    const auto sharing = sub_mesh.interface.sharing[i];
    Index first = sharing.front();
    for (const Index s : sharing)
        if (plan.rank[at(s)] < plan.rank[at(first)])
            first = s;
    return first;
}

}  // namespace

TEST_CASE("at each vertex of the interface the sub-mesh of the lowest rank leads, and no other")
{
    for_each_plan([](const Decomposition& decomposition, const SweepPlan& plan) {
        std::multiset<Index> led;
        REQUIRE(plan.roles.size() == decomposition.sub_meshes.size());
        for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[at(s)];
            REQUIRE(plan.roles[at(s)].size() == sub_mesh.interface.vertices.size());
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                const bool leads = plan.roles[at(s)][at(i)] == InterfaceRole::Leads;
                CHECK(leads == (first_at(sub_mesh, i, plan) == s));
                if (leads)
                    led.insert(sub_mesh.local_to_global[at(sub_mesh.interface.vertices[at(i)])]);
            }
        }
        CHECK(led.size() == at(decomposition.n_interface_vertices));
        CHECK(std::set<Index>(led.begin(), led.end()).size() == led.size());
    });
}

TEST_CASE("traces bring each following vertex its position from the leader, and nothing else")
{
    for_each_plan([](const Decomposition& decomposition, const SweepPlan& plan) {
        REQUIRE(plan.traces.size() == decomposition.sub_meshes.size());
        for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
            const SubMesh& to = decomposition.sub_meshes[at(s)];
            std::vector<Index> sender(at(to.n_vertices), -1);
            Index previous = -1;
            for (const Transfer& trace : plan.traces[at(s)]) {
                CHECK(trace.to == s);
                CHECK(trace.from > previous);
                previous = trace.from;
                CHECK(plan.rank[at(trace.from)] < plan.rank[at(s)]);
                const SubMesh& from = decomposition.sub_meshes[at(trace.from)];
                REQUIRE(trace.source.size() == trace.target.size());
                for (std::size_t k = 0; k < trace.source.size(); ++k) {
                    CHECK(from.local_to_global[at(trace.source[k])] == to.local_to_global[at(trace.target[k])]);
                    CHECK(sender[at(trace.target[k])] == -1);
                    sender[at(trace.target[k])] = trace.from;
                }
            }
            for (Index i = 0; i < to.interface.size(); ++i) {
                const Index first = first_at(to, i, plan);
                Index& found = sender[at(to.interface.vertices[at(i)])];
                CHECK(found == (first == s ? -1 : first));
                found = -1;
            }
            CHECK(std::all_of(sender.begin(), sender.end(), [](Index from) { return from == -1; }));
        }
    });
}

TEST_CASE("in a mutual sweep everyone leads, and every other copy of a vertex of the interface arrives once")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SweepPlan plan = plan_mutual_sweep(decomposition, color(decomposition.adjacency));
        for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            CHECK(std::all_of(plan.roles[s].begin(), plan.roles[s].end(),
                              [](InterfaceRole role) { return role == InterfaceRole::Leads; }));
            CHECK(plan.roles[s].size() == at(sub_mesh.interface.size()));
            CHECK(plan.traces[s].empty());
            std::vector<Index> arrived(at(sub_mesh.n_vertices), 0);
            for (const Transfer& copies : plan.copies[s]) {
                CHECK(copies.to == static_cast<Index>(s));
                const SubMesh& sender = decomposition.sub_meshes[at(copies.from)];
                for (std::size_t i = 0; i < copies.source.size(); ++i) {
                    CHECK(sender.local_to_global[at(copies.source[i])] ==
                          sub_mesh.local_to_global[at(copies.target[i])]);
                    ++arrived[at(copies.target[i])];
                }
            }
            for (Index i = 0; i < sub_mesh.interface.size(); ++i)
                CHECK(arrived[at(sub_mesh.interface.vertices[at(i)])] ==
                      static_cast<Index>(sub_mesh.interface.sharing[i].size()) - 1);
        }
    }
}
