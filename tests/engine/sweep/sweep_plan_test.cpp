#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "engine/sweep/sweep_plan.h"
#include "partition/cut/colouring.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Ranks to try: by colour in both directions, and each sub-mesh on its own.
std::vector<std::vector<Index>> ranks_for(const Decomposition& decomposition)
{
    const std::vector<Index> by_colour = colour(decomposition.adjacency);
    std::vector<Index> backwards = by_colour;
    for (Index& stage : backwards)
        stage = n_colours(by_colour) - 1 - stage;
    std::vector<Index> one_by_one(by_colour.size());
    std::iota(one_by_one.begin(), one_by_one.end(), 0);
    return {by_colour, backwards, one_by_one};
}

/// A tube that ends in one face of n corners, cut in quarters around it: that face belongs to none of them alone.
CutMesh tube_with_large_face(Index n)
{
    PolygonMesh mesh = cylinder(n, 3);
    std::vector<Index> end(n);
    std::iota(end.rbegin(), end.rend(), 0);
    mesh.add_face(end);
    return cut_by_place("tube with a large face", std::move(mesh), [](const Point& c) {
        if (c.z() < 0.25)
            return Index{4};
        return static_cast<Index>((c.x() > 0.0 ? 2 : 0) + (c.y() > 0.0 ? 1 : 0));
    });
}

/// Calls `check` for every cut mesh and several orders of its sub-meshes.
template <class Check>
void for_each_plan(Check&& check)
{
    std::vector<CutMesh> cuts = cut_meshes();
    cuts.push_back(tube_with_large_face(80));
    for (const CutMesh& cut : cuts) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const auto& stage : ranks_for(decomposition)) {
            const SweepPlan plan = plan_sweep(decomposition, stage);
            CHECK(plan.stage == stage);
            check(decomposition, plan);
        }
    }
}

/// Who predicts the vertices of a sub-mesh's halo, found by asking for all of them at each vertex of Γ where it leads.
std::vector<Index> senders_of_predictions(const Decomposition& decomposition, Index s, const SweepPlan& plan)
{
    const SubMesh& sub_mesh = decomposition.sub_meshes[s];
    const auto& interface = sub_mesh.interface;
    std::vector<Index> sender(sub_mesh.n_vertices + sub_mesh.n_halo, -1);
    for (Index i = 0; i < interface.size(); ++i)
        for (const Index f : interface.complement_faces[i])
            for (const Index v : interface.halo_faces[f])
                for (const Index t : interface.sharing[i]) {
                    Index& lowest = sender[v];
                    if (plan.roles[s][i] == InterfaceRole::Leads && v >= sub_mesh.n_vertices && t != s &&
                        local_index(decomposition.sub_meshes[t], sub_mesh.local_to_global[v]) >= 0)
                        lowest = lowest < 0 ? t : std::min(lowest, t);
                }
    return sender;
}

/// The sub-mesh of the earliest stage among those at the i-th vertex of Γ of a sub-mesh.
Index first_at(const SubMesh& sub_mesh, Index i, const SweepPlan& plan)
{
    const auto sharing = sub_mesh.interface.sharing[i];
    Index first = sharing.front();
    for (const Index s : sharing)
        if (plan.stage[s] < plan.stage[first])
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
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            REQUIRE(plan.roles[s].size() == sub_mesh.interface.vertices.size());
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                const bool leads = plan.roles[s][i] == InterfaceRole::Leads;
                CHECK(leads == (first_at(sub_mesh, i, plan) == s));
                if (leads)
                    led.insert(sub_mesh.local_to_global[sub_mesh.interface.vertices[i]]);
            }
        }
        CHECK(led.size() == usize(decomposition.n_interface_vertices));
        CHECK(std::set<Index>(led.begin(), led.end()).size() == led.size());
    });
}

TEST_CASE("traces bring each following vertex its position from the leader, and nothing else")
{
    for_each_plan([](const Decomposition& decomposition, const SweepPlan& plan) {
        REQUIRE(plan.traces.size() == decomposition.sub_meshes.size());
        for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
            const SubMesh& to = decomposition.sub_meshes[s];
            std::vector<Index> sender(to.n_vertices, -1);
            Index previous = -1;
            for (const Transfer& trace : plan.traces[s]) {
                CHECK(trace.to == s);
                CHECK(trace.from > previous);
                previous = trace.from;
                CHECK(plan.stage[trace.from] < plan.stage[s]);
                const SubMesh& from = decomposition.sub_meshes[trace.from];
                REQUIRE(trace.source.size() == trace.target.size());
                for (std::size_t k = 0; k < trace.source.size(); ++k) {
                    CHECK(from.local_to_global[trace.source[k]] == to.local_to_global[trace.target[k]]);
                    CHECK(sender[trace.target[k]] == -1);
                    sender[trace.target[k]] = trace.from;
                }
            }
            for (Index i = 0; i < to.interface.size(); ++i) {
                const Index first = first_at(to, i, plan);
                Index& found = sender[to.interface.vertices[i]];
                CHECK(found == (first == s ? -1 : first));
                found = -1;
            }
            CHECK(std::all_of(sender.begin(), sender.end(), [](Index from) { return from == -1; }));
        }
    });
}

TEST_CASE("predictions bring each vertex beyond a led one from the lowest sub-mesh that has it, and nothing else")
{
    for_each_plan([](const Decomposition& decomposition, const SweepPlan& plan) {
        for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
            const SubMesh& to = decomposition.sub_meshes[s];
            std::vector<Index> sender(to.n_vertices + to.n_halo, -1);
            for (const Transfer& prediction : plan.predictions[s]) {
                const SubMesh& from = decomposition.sub_meshes[prediction.from];
                for (std::size_t k = 0; k < prediction.source.size(); ++k) {
                    CHECK(from.local_to_global[prediction.source[k]] == to.local_to_global[prediction.target[k]]);
                    CHECK(sender[prediction.target[k]] == -1);
                    sender[prediction.target[k]] = prediction.from;
                }
            }
            CHECK(sender == senders_of_predictions(decomposition, s, plan));
        }
    });
}

TEST_CASE("in a mutual sweep everyone leads, and every other copy of a vertex of the interface arrives once")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SweepPlan plan = plan_mutual_sweep(decomposition, colour(decomposition.adjacency));
        for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            CHECK(std::all_of(plan.roles[s].begin(), plan.roles[s].end(),
                              [](InterfaceRole role) { return role == InterfaceRole::Leads; }));
            CHECK(plan.roles[s].size() == usize(sub_mesh.interface.size()));
            CHECK(plan.traces[s].empty());
            std::vector<Index> arrived(sub_mesh.n_vertices, 0);
            for (const Transfer& copies : plan.copies[s]) {
                CHECK(copies.to == static_cast<Index>(s));
                const SubMesh& sender = decomposition.sub_meshes[copies.from];
                for (std::size_t i = 0; i < copies.source.size(); ++i) {
                    CHECK(sender.local_to_global[copies.source[i]] == sub_mesh.local_to_global[copies.target[i]]);
                    ++arrived[copies.target[i]];
                }
            }
            for (Index i = 0; i < sub_mesh.interface.size(); ++i)
                CHECK(arrived[sub_mesh.interface.vertices[i]] ==
                      static_cast<Index>(sub_mesh.interface.sharing[i].size()) - 1);
        }
    }
}
