#include "engine/sweep/sweep_plan.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace seamflow {

namespace {

/// The transfers to sub-mesh s at those vertices of its Γ at which another sub-mesh solves earlier.
std::vector<Transfer> list_traces(const Decomposition& decomposition, Index s, const std::vector<Index>& stage)
{
    const auto& interface = decomposition.sub_meshes[s].interface;
    std::vector<TransferRow> rows;
    for (Index i = 0; i < interface.size(); ++i) {
        const auto sharing = interface.sharing[i];
        const auto leader = std::ranges::min_element(sharing, {}, [&](Index t) { return stage[t]; });
        if (stage[*leader] < stage[s])
            rows.push_back({*leader, interface.index_in_sharing[i][static_cast<std::size_t>(leader - sharing.begin())],
                            interface.vertices[i]});
    }
    return transfers_to(s, std::move(rows));
}

/// The roles of sub-mesh s: it leads at vertices where it solves first.
std::vector<InterfaceRole> list_roles(const SubMeshInterface& interface, Index s, const std::vector<Index>& stage)
{
    std::vector<InterfaceRole> roles;
    roles.reserve(interface.vertices.size());
    for (Index i = 0; i < interface.size(); ++i) {
        assert(std::ranges::none_of(interface.sharing[i], [&](Index t) { return t != s && stage[t] == stage[s]; }) &&
               "adjacent sub-meshes have different stages");
        const bool leads = std::ranges::none_of(interface.sharing[i], [&](Index t) { return stage[t] < stage[s]; });
        roles.push_back(leads ? InterfaceRole::Leads : InterfaceRole::Follows);
    }
    return roles;
}

/// The row by which the position of a vertex of the halo reaches s: from the lowest of the sub-meshes `sharing`, s
/// excluded, that has this vertex among its own.
/// @param sharing the sub-meshes at a vertex of Γ that has a face beyond Γ in common with the vertex of the halo.
/// @param halo_vertex its local number in s.
TransferRow row_from_sender(const Decomposition& decomposition, std::span<const Index> sharing, Index s,
                            Index halo_vertex)
{
    const Index vertex = decomposition.sub_meshes[s].local_to_global[halo_vertex];
    for (const Index t : sharing)
        if (t != s)
            if (const Index local = local_index(decomposition.sub_meshes[t], vertex); local >= 0)
                return {t, local, halo_vertex};
    assert(false && "a face beyond Γ belongs to a sub-mesh with all its vertices");
    return {-1, -1, -1};
}

/// The lowest sub-mesh at a vertex of Γ, s excluded.
Index lowest_but(Index s, std::span<const Index> sharing)
{
    return sharing[0] == s ? sharing[1] : sharing[0];
}

/// Faces beyond Γ with so many corners that visiting all other corners from each corner would take too long. Corners at
/// which the same sub-meshes meet have the same senders, so that the face is visited from one of them.
class LargeFaces {
  public:
    explicit LargeFaces(const SubMeshInterface& interface)
        : interface_(interface)
    {
    }

    /// Whether the face has been visited from another vertex of Γ where the same sub-meshes meet; false for small
    /// faces.
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

/// Sets the transfers of predictions to sub-mesh s: one sender for each vertex of its halo that shares a face with a
/// vertex of Γ where s leads.
/// @param plan has the roles of s.
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
                // The lowest sender is taken, so that the choice does not depend on the numbering of vertices.
                TransferRow& sender = senders[v - sub_mesh.n_vertices];
                // No sub-mesh at this vertex of Γ is lower than the sender found before.
                if (sender.from >= 0 && sender.from <= lowest_but(s, interface.sharing[i]))
                    continue;
                if (const TransferRow found = row_from_sender(decomposition, interface.sharing[i], s, v);
                    sender.from < 0 || (found.from >= 0 && found.from < sender.from))
                    sender = found;
            }
        }
    }
    std::erase_if(senders, [](const TransferRow& row) { return row.from < 0; });
    plan.predictions[s] = transfers_to(s, std::move(senders));
}

/// The transfers to sub-mesh s of the other sub-meshes' copies of its Γ (see SweepPlan::copies).
std::vector<Transfer> list_copies(const Decomposition& decomposition, Index s)
{
    const auto& interface = decomposition.sub_meshes[s].interface;
    std::vector<TransferRow> rows;
    for (Index i = 0; i < interface.size(); ++i)
        for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
            if (const Index t = interface.sharing[i][k]; t != s)
                rows.push_back({t, interface.index_in_sharing[i][k], interface.vertices[i]});
    return transfers_to(s, std::move(rows));
}

}  // namespace

SweepPlan empty_plan(std::vector<Index> stage)
{
    const std::size_t n = stage.size();
    SweepPlan plan;
    plan.stage = std::move(stage);
    plan.roles.resize(n);
    plan.traces.resize(n);
    plan.predictions.resize(n);
    plan.copies.resize(n);
    return plan;
}

SweepPlan plan_mutual_sweep(const Decomposition& decomposition, std::vector<Index> stage, const Executor& exec)
{
    SweepPlan plan = empty_plan(std::move(stage));
    for_each(exec, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        plan.roles[s].assign(decomposition.sub_meshes[s].interface.size(), InterfaceRole::Leads);
        plan.copies[s] = list_copies(decomposition, s);
    });
    return plan;
}

SweepPlan plan_sweep(const Decomposition& decomposition, std::vector<Index> stage, const Executor& exec)
{
    SweepPlan plan = empty_plan(std::move(stage));
    for_each(exec, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        plan.traces[s] = list_traces(decomposition, s, plan.stage);
        plan.roles[s] = list_roles(decomposition.sub_meshes[s].interface, s, plan.stage);
        plan_predictions(decomposition, s, plan);
    });
    return plan;
}

SweepPlan plan_overlapping_sweep(const Decomposition& decomposition, std::vector<Index> stage)
{
    SweepPlan plan = empty_plan(std::move(stage));
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
        plan.roles[s].assign(decomposition.sub_meshes[s].interface.vertices.size(), InterfaceRole::Follows);
        plan.traces[s] = list_traces(decomposition, s, plan.stage);
    }
    return plan;
}

}  // namespace seamflow
