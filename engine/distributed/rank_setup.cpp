#include "engine/distributed/rank_setup.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/rank_peers.h"
#include "engine/measure/remarks.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/constraints.h"
#include "engine/steppers/sweep_order.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "partition/connected_components.h"
#include "partition/decomposition/part_of_mesh.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/inspection/mesh_inspection.h"
#include "partition/labels.h"
#include "partition/repair/pinches.h"
#include "solvers/laplacian/degenerate.h"

namespace seamflow {

namespace {

/// Each label once, ascending.
std::vector<Index> distinct(const std::vector<Index>& labels)
{
    // Neighbouring faces mostly have the same label.
    std::vector<Index> numbers;
    std::ranges::unique_copy(labels, std::back_inserter(numbers));
    sort_unique(numbers);
    return numbers;
}

/// Finds the sub-meshes that a rank knows, whole or in part, and makes the labels places among them.
/// @param all sub-meshes of all ranks, ascending.
std::vector<KnownSubMesh> localise_labels(const std::vector<OwnedSubMesh>& all, MeshPart& part)
{
    std::vector<KnownSubMesh> known;
    for (const Index number : distinct(part.labels))
        known.push_back(
            {.number = number, .rank = std::ranges::lower_bound(all, number, {}, &OwnedSubMesh::number)->rank});
    for_each(run_in_parallel, part.mesh.n_faces(), [&](Index f) {
        const auto place = std::ranges::lower_bound(known, part.labels[f], {}, &KnownSubMesh::number);
        part.labels[f] = static_cast<Index>(place - known.begin());
    });
    for (Index f = part.mesh.n_faces(); f-- > 0;)
        known[part.labels[f]].faces = {part.face_numbers[f]};
    return known;
}

/// All sub-meshes of all ranks, in ascending order of their numbers.
/// @throws InputError for a sub-mesh that several ranks have.
std::vector<OwnedSubMesh> gather_sub_meshes(Communicator& comm, const MeshPart& part)
{
    std::vector<OwnedSubMesh> own;
    for (const Index number : distinct(part.labels))
        own.push_back({number, comm.rank()});
    std::vector<OwnedSubMesh> all = comm.gather_all(own);
    std::ranges::stable_sort(all, {}, &OwnedSubMesh::number);
    const auto shared = std::ranges::adjacent_find(all, {}, &OwnedSubMesh::number);
    if (shared != all.end())
        throw InputError(fmt::format("sub-mesh {} has faces of rank {} and of rank {}: give all to one", shared->number,
                                     shared->rank, std::next(shared)->rank));
    return all;
}

/// The faces of this rank that do not repeat others, as indices into its part. As on a single machine, only repeated
/// faces at non-manifold vertices are found.
std::vector<Index> faces_left(const MeshPart& own, const MeshPart& known, const Topology& topology)
{
    const auto is_suspicious = [&](Index v) { return topology.kind[v] == VertexKind::NonManifold; };
    const auto candidates = select(run_in_parallel, known.mesh.n_faces(),
                                   [&](Index f) { return std::ranges::any_of(known.mesh.face(f), is_suspicious); });
    std::vector<std::int64_t> repeated;
    for (const RepeatedFace& face : find_repeated_faces(known.mesh, candidates))
        repeated.push_back(known.face_numbers[face.face]);
    std::ranges::sort(repeated);
    return select(run_in_parallel, own.mesh.n_faces(),
                  [&](Index f) { return !std::ranges::binary_search(repeated, own.face_numbers[f]); });
}

/// The sum of a number over all ranks.
std::int64_t sum_of_all(Communicator& comm, std::int64_t own)
{
    const auto numbers = comm.gather_all(std::vector<std::int64_t>{own});
    return std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0});
}

/// Leaves out faces that repeat others, once more is known of the part.
/// @param mesh receives part and topology, before they are prepared for a flow.
void grow(Communicator& comm, const MeshPart& own, RankMesh& mesh)
{
    // With two layers, all that have the vertices around those of its sub-meshes are known.
    constexpr int layers = 2;
    const auto grow_from = [&](const MeshPart& part) {
        mesh.part = grown_by_layers(comm, part, layers);
        mesh.topology = make_topology(mesh.part.mesh, run_in_parallel);
    };
    grow_from(own);
    const std::vector<Index> left = faces_left(own, mesh.part, mesh.topology);
    mesh.n_faces = sum_of_all(comm, own.mesh.n_faces());
    mesh.n_repeated = sum_of_all(comm, own.mesh.n_faces() - static_cast<std::int64_t>(left.size()));
    if (mesh.n_repeated == 0) {
        mesh.all = gather_sub_meshes(comm, own);
        return;
    }
    const MeshPart without = some_faces(own, left);
    mesh.all = gather_sub_meshes(comm, without);
    grow_from(without);
    mesh.remarks.push_back(remark_on_repeated_faces(mesh.n_repeated));
}

/// @param what the numbers are. @throws InputError if some ranks with vertices have them and others do not.
void require_alike(Communicator& comm, const MeshPart& own, const std::vector<double>& numbers, std::string_view what)
{
    std::vector<std::uint8_t> has_numbers;
    if (own.mesh.n_vertices() > 0)
        has_numbers.push_back(numbers.empty() ? 0 : 1);
    const std::vector<std::uint8_t> of_all = comm.gather_all(has_numbers);
    if (std::ranges::adjacent_find(of_all, std::not_equal_to<>()) != of_all.end())
        throw InputError(fmt::format("some ranks have {} and others have none: give them on all, or on none", what));
}

[[noreturn]] void refuse_cut(const std::string& what)
{
    throw InputError(what + ": use the mended labels that a flow of the same mesh reports");
}

/// @throws InputError for a sub-mesh of this rank whose faces would have to be moved (see repair).
void require_sound_cut(const RankMesh& mesh)
{
    // A mesh that is not cut may be of any kind.
    if (mesh.all.size() == 1)
        return;
    const PolygonMesh& faces = mesh.part.mesh;
    std::vector<Index> labels = mesh.part.labels;
    const auto is_own_face = [&](Index f) { return mesh.is_own[labels[f]] != 0; };
    const Components components = connected_components(faces.n_faces(), [&](Index f, auto&& visit) {
        for_each_neighbour(faces, mesh.topology, f, [&](Index, Index g) {
            if (labels[f] == labels[g])
                visit(g);
        });
    });
    std::vector<Index> n_components(mesh.known.size(), 0);
    for (Index c = 0; c < components.count(); ++c)
        if (const Index f = components.nodes[c].front(); is_own_face(f) && ++n_components[labels[f]] > 1)
            refuse_cut(fmt::format("sub-mesh {}, with face {}, is not connected through edges",
                                   mesh.known[labels[f]].number, mesh.part.face_numbers[f]));

    PinchMender pinches(faces, mesh.topology, labels, static_cast<Index>(mesh.known.size()));
    const auto has_own_face = [&](Index v) {
        return std::ranges::any_of(mesh.topology.corners_at(v),
                                   [&](Index corner) { return is_own_face(mesh.topology.face_of[corner]); });
    };
    for (const Index v : select(run_in_parallel, faces.n_vertices(), [&](Index one) {
             return may_be_pinched(faces, mesh.topology, labels, one) && has_own_face(one);
         }))
        if (pinches.pinches_at(v) > 0)
            refuse_cut(fmt::format("a sub-mesh has several fans of faces at vertex {}", mesh.part.vertex_numbers[v]));
}

/// Some vertices of the whole mesh: how many, and the lowest number among them.
struct CountedVertices {
    std::int64_t n = 0;
    std::int64_t lowest = -1;
};

/// Each vertex is counted where its lowest sub-mesh is. All ranks call this together.
template <class Holds>
CountedVertices count_vertices(Communicator& comm, const RankMesh& mesh, Holds&& holds)
{
    const auto is_counted_here = [&](Index v) {
        auto lowest = static_cast<Index>(mesh.known.size());
        for (const Index corner : mesh.topology.corners_at(v))
            lowest = std::min(lowest, mesh.part.labels[mesh.topology.face_of[corner]]);
        return lowest < static_cast<Index>(mesh.known.size()) && mesh.is_own[lowest] != 0;
    };
    const std::vector<Index> counted =
        select(run_in_parallel, mesh.part.mesh.n_vertices(), [&](Index v) { return holds(v) && is_counted_here(v); });
    CountedVertices own{.n = std::ssize(counted)};
    if (!counted.empty())
        own.lowest = mesh.part.vertex_numbers[counted.front()];
    CountedVertices all;
    for (const CountedVertices& of_rank : comm.gather_all(std::vector<CountedVertices>{own})) {
        if (of_rank.n > 0 && (all.n == 0 || of_rank.lowest < all.lowest))
            all.lowest = of_rank.lowest;
        all.n += of_rank.n;
    }
    return all;
}

/// Holds the vertices at which the Laplacian is not defined.
/// @throws InputError if this leaves no vertex of the whole mesh to move.
void hold_undefined(Communicator& comm, const FlowOptions& options, RankMesh& mesh)
{
    const Laplacian laplacian = options.laplacian;
    const auto undefined = vertices_without_row(mesh.part.mesh, mesh.topology, laplacian, run_in_parallel);
    const CountedVertices moving = count_vertices(comm, mesh, [&](Index v) { return mesh.topology.moves(v); });
    const CountedVertices held =
        count_vertices(comm, mesh, [&](Index v) { return std::ranges::binary_search(undefined, v); });
    hold(mesh.topology, undefined);
    if (moving.n == 0 && mesh.n_faces > 0)
        mesh.remarks.push_back(remark_on_unmoving_mesh(options.motion.boundary));
    if (held.n == 0)
        return;
    mesh.remarks.push_back(remark_on_undefined_vertices(held.n, held.lowest, laplacian));
    if (held.n == moving.n)
        throw InputError("nothing can move: " + mesh.remarks.back());
}

/// For each sub-mesh of all ranks, those with which it shares a vertex of Γ; places among all.
std::vector<std::vector<Index>> gather_adjacency(Communicator& comm, const RankMesh& mesh,
                                                 const std::vector<Index>& places, const Decomposition& decomposition,
                                                 std::size_t n_of_all)
{
    struct Pair {
        Index from;
        Index to;
    };
    std::vector<Pair> own;
    for (std::size_t s = 0; s < places.size(); ++s)
        if (mesh.is_own[s] != 0)
            for (const Index neighbour : decomposition.adjacency[s])
                own.push_back({places[s], places[neighbour]});
    std::vector<std::vector<Index>> adjacency(n_of_all);
    for (const auto& [from, to] : comm.gather_all(own))
        adjacency[from].push_back(to);
    return adjacency;
}

/// Σ‖ΔV⁰‖ of each sub-mesh of all ranks.
std::vector<double> gather_curvatures(Communicator& comm, const RankMesh& mesh, const std::vector<Index>& places,
                                      const Decomposition& decomposition, const FlowOptions& options,
                                      std::size_t n_of_all)
{
    struct Total {
        Index place;
        double curvature;
    };
    const PolygonMesh& faces = mesh.part.mesh;
    const auto totals =
        total_curvatures(decomposition, measure_curvature(faces, mesh.topology, faces.vertices, laplacian_of(options)));
    std::vector<Total> own;
    for (std::size_t s = 0; s < places.size(); ++s)
        if (mesh.is_own[s] != 0)
            own.push_back({places[s], totals[s]});
    std::vector<double> of_all(n_of_all, 0.0);
    for (const auto& [place, curvature] : comm.gather_all(own))
        of_all[place] = curvature;
    return of_all;
}

/// The places of the known sub-meshes among all.
std::vector<Index> places_among(const std::vector<OwnedSubMesh>& all, const std::vector<KnownSubMesh>& known)
{
    std::vector<Index> places;
    for (const KnownSubMesh& sub_mesh : known)
        places.push_back(static_cast<Index>(std::ranges::lower_bound(all, sub_mesh.number, {}, &OwnedSubMesh::number) -
                                            all.begin()));
    return places;
}

/// Windows that are large enough forward and backward, whatever crosses Γ: as if every sub-mesh needed the results of
/// all around it. Ranks that each have their part of both orders, and windows of at least this size, do not wait for
/// each other in a circle: a solution waits for factorisations at lower places than those that wait for it.
std::vector<FactorWindow> sufficient_windows(const std::vector<std::vector<Index>>& adjacency,
                                             const std::vector<Index>& stage)
{
    const std::vector<Index> order = reverse_cuthill_mckee(adjacency);
    std::vector<FactorWindow> windows;
    for (const auto& direction : {stage, reversed(stage)}) {
        SweepPlan plan = empty_plan(direction);
        for (std::size_t s = 0; s < adjacency.size(); ++s)
            for (const Index neighbour : adjacency[s])
                (direction[neighbour] < direction[s] ? plan.traces : plan.predictions)[s].push_back(
                    {.from = neighbour, .to = static_cast<Index>(s), .source = {}, .target = {}});
        windows.push_back(least_window(plan, order_by_need(plan, order)));
    }
    return windows;
}

/// The own ones of all sub-meshes, by their numbers here.
std::vector<Index> own_of(const RankMesh& mesh, const std::vector<Index>& places, const std::vector<Index>& all)
{
    std::vector<Index> own;
    for (const Index place : all)
        if (const Index s = position_in(places, place); s >= 0 && mesh.is_own[s] != 0)
            own.push_back(s);
    return own;
}

}  // namespace

BoundingBox gather_box(Communicator& comm, const PolygonMesh& mesh)
{
    std::vector<std::array<double, 6>> own;
    if (mesh.n_faces() > 0) {
        const auto [low, high] = box_of_faces(mesh);
        own.push_back({low[0], low[1], low[2], high[0], high[1], high[2]});
    }
    const auto boxes = comm.gather_all(own);
    BoundingBox all;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            all.low[c] = i == 0 ? boxes[i][c] : std::min(all.low[c], boxes[i][c]);
            all.high[c] = i == 0 ? boxes[i][c + 3] : std::max(all.high[c], boxes[i][c + 3]);
        }
    return all;
}

bool RankMesh::has_own_faces(Index v) const
{
    return std::ranges::any_of(topology.corners_at(v),
                               [&](Index corner) { return is_own[part.labels[topology.face_of[corner]]] != 0; });
}

RankMesh make_rank_mesh(Communicator& comm, const MeshPart& own, const Point& offset, const FlowOptions& options,
                        SoundCut sound)
{
    RankMesh mesh;
    require_alike(comm, own, own.attachment_weights, "attachment weights");
    require_alike(comm, own, own.strengths, "strengths");
    grow(comm, own, mesh);
    const std::string_view need = need_of_junctions(options);
    if (options.motion.junctions == Junctions::Flow && need.empty())
        free_junctions(mesh.part.mesh, mesh.topology, run_in_parallel);
    mesh.part.mesh.vertices.rowwise() -= offset;
    mesh.known = localise_labels(mesh.all, mesh.part);
    for (const KnownSubMesh& sub_mesh : mesh.known)
        mesh.is_own.push_back(sub_mesh.rank == comm.rank() ? 1 : 0);
    if (sound == SoundCut::Required)
        require_sound_cut(mesh);
    if (options.motion.boundary == Boundary::Free)
        free_boundary(mesh.topology);
    const auto is_still = [&](Index v) {
        return !mesh.part.strengths.empty() && mesh.part.strengths[v] < MotionOptions::least_strength;
    };
    hold(mesh.topology, select(run_in_parallel, mesh.part.mesh.n_vertices(),
                               [&](Index v) { return mesh.part.fixed[v] != 0 || is_still(v); }));
    const auto n_of = [&](auto&& holds) { return count_vertices(comm, mesh, holds).n; };
    mesh.n_vertices = n_of([](Index /*v*/) { return true; });
    if (mesh.n_vertices > 0 && n_of(is_still) == mesh.n_vertices)
        mesh.remarks.push_back(remark_on_empty_region());
    hold_undefined(comm, options, mesh);
    if (options.accuracy.approach == Approach::Sweep)
        comm.look_together([&] {
            std::vector<Index> rim = moving_rim(mesh.part.mesh, mesh.topology);
            std::erase_if(rim, [&](Index v) { return !mesh.has_own_faces(v); });
            require_boundary_unshared(mesh.topology, mesh.part.labels, rim);
        });
    // At the rim of a region faces may be left out, which is nothing to report.
    const auto count_kind = [&](VertexKind kind) {
        return n_of([&](Index v) { return mesh.topology.kind[v] == kind && !is_still(v); });
    };
    mesh.n_non_manifold = count_kind(VertexKind::NonManifold);
    mesh.n_junctions = count_kind(VertexKind::Junction);
    if (mesh.n_non_manifold > 0)
        mesh.remarks.push_back(remark_on_non_manifold_vertices(mesh.n_non_manifold, need));
    if (mesh.n_junctions > 0)
        mesh.remarks.push_back(remark_on_junctions(mesh.n_junctions, options.laplacian));
    return mesh;
}

Decomposition decompose_rank_mesh(RankMesh& mesh)
{
    Decomposition decomposition =
        decompose_part(mesh.part.mesh, mesh.topology, mesh.part.labels, mesh.is_own, run_in_parallel);
    for (std::size_t s = 0; s < mesh.known.size(); ++s)
        mesh.known[s].n_vertices = decomposition.sub_meshes[s].n_vertices;
    return decomposition;
}

RankSubMeshes make_rank_sub_meshes(Communicator& comm, const RankMesh& mesh, Decomposition decomposition,
                                   const FlowOptions& options, ForeignSubMeshes& foreign)
{
    const std::vector<OwnedSubMesh>& all = mesh.all;
    const std::vector<Index> places = places_among(all, mesh.known);
    RankSubMeshes result;
    result.decomposition = std::move(decomposition);
    result.n_of_all_ranks = all.size();
    result.foreign = &foreign;
    result.topology = &mesh.topology;
    result.peers = make_rank_peers(comm, mesh);
    const auto adjacency = gather_adjacency(comm, mesh, places, result.decomposition, all.size());
    const auto curvatures = gather_curvatures(comm, mesh, places, result.decomposition, options, all.size());
    const std::vector<Index> stage_of_all = assign_stages(adjacency, options.interface.colouring, curvatures);
    for (const Index place : places)
        result.stage.push_back(stage_of_all[place]);
    for (const FactorWindow& window : sufficient_windows(adjacency, stage_of_all))
        result.windows.push_back({own_of(mesh, places, window.order), own_of(mesh, places, window.freed), window.size});
    return result;
}

std::unique_ptr<InterfacePeers> make_rank_peers(Communicator& comm, const RankMesh& mesh)
{
    std::vector<Index> holders;
    for (const OwnedSubMesh& sub_mesh : mesh.all)
        holders.push_back(sub_mesh.rank);
    return std::make_unique<RankPeers>(comm, std::move(holders), places_among(mesh.all, mesh.known));
}

PeerSubMeshes make_peer_sub_meshes(Communicator& comm, const RankMesh& mesh, Decomposition decomposition)
{
    return {std::move(decomposition), make_rank_peers(comm, mesh),
            [known = mesh.known](Index s, const std::function<void()>& body) {
                run_for_sub_mesh(known[s], known[s].number, body);
            }};
}

}  // namespace seamflow
