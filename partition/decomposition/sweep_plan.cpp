#include "partition/decomposition/sweep_plan.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace seamflow {

namespace {

/// Position, among the sub-meshes at a vertex of Γ, of the one that solves first.
std::size_t leader_among(std::span<const Index> sharing, const std::vector<Index>& rank)
{
    const auto leader =
        std::min_element(sharing.begin(), sharing.end(), [&](Index s, Index t) { return rank[s] < rank[t]; });
    return static_cast<std::size_t>(leader - sharing.begin());
}

void plan_sub_mesh(const Decomposition& decomposition, Index s, SweepPlan& plan)
{
    const auto& interface = decomposition.sub_meshes[s].interface;
    std::vector<TransferRow> rows;
    plan.roles[s].reserve(interface.size());
    for (Index i = 0; i < interface.size(); ++i) {
        const std::size_t first = leader_among(interface.sharing[i], plan.rank);
        const Index leader = interface.sharing[i][first];
        plan.roles[s].push_back(leader == s ? InterfaceRole::Leads : InterfaceRole::Follows);
        assert((leader == s || plan.rank[leader] < plan.rank[s]) && "adjacent sub-meshes have different ranks");
        if (leader != s)
            rows.push_back({leader, interface.index_in_sharing[i][first], interface.vertices[i]});
    }
    plan.traces[s] = transfers_to(s, rows);
}

/// The sub-mesh, other than s itself, that speaks for a vertex beyond Γ: the lowest of those at a vertex of Γ, of which
/// one has all faces of both.
TransferRow sender_of(const Decomposition& decomposition, std::span<const Index> sharing, Index s, Index halo_vertex)
{
    const Index vertex = decomposition.sub_meshes[s].local_to_global[halo_vertex];
    for (const Index t : sharing)
        if (t != s)
            if (const Index local = local_index(decomposition.sub_meshes[t], vertex); local >= 0)
                return {t, local, halo_vertex};
    assert(false && "a face beyond Γ belongs to a sub-mesh with all its vertices");
    return {-1, -1, -1};
}

/// The lowest of the sub-meshes at a vertex of Γ other than s.
Index lowest_but(Index s, std::span<const Index> sharing)
{
    return sharing[0] == s ? sharing[1] : sharing[0];
}

/// Faces beyond Γ with many corners, each of which would look at all others. Those at which the same sub-meshes meet
/// see the same.
class LargeFaces {
  public:
    explicit LargeFaces(const SubMeshInterface& interface)
        : interface_(interface)
    {
    }

    /// Whether a vertex of Γ at which the same sub-meshes meet has asked for the face; never of a small one.
    bool has_been_seen_from_like(Index face, Index vertex)
    {
        constexpr std::size_t many = 32;
        if (interface_.halo_faces[face].size() <= many)
            return false;
        const auto sharing = interface_.sharing[vertex];
        const auto is_alike = [&](const Seen& seen) {
            return seen.face == face && std::ranges::equal(interface_.sharing[seen.vertex], sharing);
        };
        if (std::ranges::any_of(seen_, is_alike))
            return true;
        seen_.push_back({face, vertex});
        return false;
    }

  private:
    struct Seen {
        Index face;
        Index vertex;
    };

    const SubMeshInterface& interface_;
    std::vector<Seen> seen_;
};

void plan_predictions(const Decomposition& decomposition, Index s, SweepPlan& plan)
{
    const SubMesh& sub_mesh = decomposition.sub_meshes[s];
    const auto& interface = sub_mesh.interface;
    std::vector<TransferRow> senders(sub_mesh.n_halo, {-1, -1, -1});
    LargeFaces large_faces(interface);
    for (Index i = 0; i < interface.size(); ++i) {
        if (plan.roles[s][i] == InterfaceRole::Follows)
            continue;
        for (const Index f : interface.complement_faces[i]) {
            if (large_faces.has_been_seen_from_like(f, i))
                continue;
            for (const Index v : interface.halo_faces[f]) {
                if (v < sub_mesh.n_vertices)
                    continue;
                // The lowest of all, so that the choice does not depend on how vertices are numbered.
                TransferRow& sender = senders[v - sub_mesh.n_vertices];
                if (sender.from >= 0 && sender.from <= lowest_but(s, interface.sharing[i]))
                    continue;
                if (const TransferRow found = sender_of(decomposition, interface.sharing[i], s, v);
                    sender.from < 0 || (found.from >= 0 && found.from < sender.from))
                    sender = found;
            }
        }
    }
    std::erase_if(senders, [](const TransferRow& row) { return row.from < 0; });
    plan.predictions[s] = transfers_to(s, senders);
}

std::vector<Transfer> list_copies(const Decomposition& decomposition, Index s)
{
    const auto& interface = decomposition.sub_meshes[s].interface;
    std::vector<TransferRow> rows;
    for (Index i = 0; i < interface.size(); ++i)
        for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
            if (const Index t = interface.sharing[i][k]; t != s)
                rows.push_back({t, interface.index_in_sharing[i][k], interface.vertices[i]});
    return transfers_to(s, rows);
}

}  // namespace

SweepPlan empty_plan(std::vector<Index> rank)
{
    const std::size_t n = rank.size();
    SweepPlan plan;
    plan.rank = std::move(rank);
    plan.roles.resize(n);
    plan.traces.resize(n);
    plan.predictions.resize(n);
    plan.copies.resize(n);
    return plan;
}

SweepPlan plan_mutual_sweep(const Decomposition& decomposition, std::vector<Index> rank, const Loop& loop)
{
    SweepPlan plan = empty_plan(std::move(rank));
    for_each(loop, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        plan.roles[s].assign(decomposition.sub_meshes[s].interface.size(), InterfaceRole::Leads);
        plan.copies[s] = list_copies(decomposition, s);
    });
    return plan;
}

SweepPlan plan_sweep(const Decomposition& decomposition, std::vector<Index> rank, const Loop& loop)
{
    SweepPlan plan = empty_plan(std::move(rank));
    for_each(loop, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        plan_sub_mesh(decomposition, s, plan);
        plan_predictions(decomposition, s, plan);
    });
    return plan;
}

}  // namespace seamflow
