#include "partition/decomposition/sweep_plan.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace seamflow {

namespace {

/// Position, among the sub-meshes at a vertex of Γ, of the one that solves first.
std::size_t leader_among(std::span<const Index> sharing, const std::vector<Index>& rank)
{
    const auto leader =
        std::min_element(sharing.begin(), sharing.end(), [&](Index s, Index t) { return rank[at(s)] < rank[at(t)]; });
    return static_cast<std::size_t>(leader - sharing.begin());
}

void plan_sub_mesh(const Decomposition& decomposition, Index s, SweepPlan& plan)
{
    const auto& interface = decomposition.sub_meshes[at(s)].interface;
    std::map<Index, Transfer> by_leader;
    for (Index i = 0; i < interface.size(); ++i) {
        const std::size_t first = leader_among(interface.sharing[i], plan.rank);
        const Index leader = interface.sharing[i][first];
        plan.roles[at(s)].push_back(leader == s ? InterfaceRole::Leads : InterfaceRole::Follows);
        if (leader == s)
            continue;
        by_leader[leader].source.push_back(interface.index_in_sharing[i][first]);
        by_leader[leader].target.push_back(interface.vertices[at(i)]);
    }
    for (auto& [leader, transfer] : by_leader) {
        assert(plan.rank[at(leader)] < plan.rank[at(s)] && "adjacent sub-meshes have different ranks");
        transfer.from = leader;
        transfer.to = s;
        plan.traces[at(s)].push_back(std::move(transfer));
    }
}

}  // namespace

SweepPlan plan_sweep(const Decomposition& decomposition, std::vector<Index> rank)
{
    SweepPlan plan;
    plan.rank = std::move(rank);
    plan.roles.resize(decomposition.sub_meshes.size());
    plan.traces.resize(decomposition.sub_meshes.size());
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s)
        plan_sub_mesh(decomposition, s, plan);
    return plan;
}

}  // namespace seamflow
