#include "partition/repair/repair.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "partition/labels.h"
#include "partition/large_arrays.h"
#include "partition/repair/loose_components.h"
#include "partition/repair/pinches.h"

namespace seamflow {

namespace {

/// The most rounds of repair. Cuts by METIS need two or three; a cut that needs more than this gets its pinched parts
/// merged.
constexpr int max_repair_rounds = 12;

/// Vertices to examine, each once.
class VertexQueue {
  public:
    VertexQueue(Index n_vertices, std::vector<Index> vertices)
        : queued_(n_vertices, false)
        , vertices_(std::move(vertices))
    {
        for (const Index v : vertices_)
            queued_[v] = true;
    }

    /// Adds the vertices of the faces that are not in the queue.
    void add_corners_of(const PolygonMesh& mesh, const std::vector<Index>& faces)
    {
        for (const Index f : faces)
            for (const Index v : mesh.face(f))
                if (!queued_[v]) {
                    queued_[v] = true;
                    vertices_.push_back(v);
                }
    }

    /// Empties the queue. @returns its contents.
    std::vector<Index> take()
    {
        for (const Index v : vertices_)
            queued_[v] = false;
        return std::exchange(vertices_, {});
    }

  private:
    std::vector<bool> queued_;
    std::vector<Index> vertices_;
};

/// The parts and vertices to examine first.
struct Suspects {
    /// One entry per label: whether the part may not be connected.
    std::vector<bool> parts;
    /// The vertices that are pinched, and perhaps others, ascending.
    std::vector<Index> vertices;
};

/// All parts, and all vertices that may be pinched.
Suspects suspect_all(const PolygonMesh& mesh, const Topology& topology, Index n_labels,
                     const std::vector<Index>& labels, const Executor& exec)
{
    return {
        .parts = std::vector<bool>(n_labels, true),
        .vertices = select(exec, mesh.n_vertices(), [&](Index v) { return may_be_pinched(mesh, topology, labels, v); }),
    };
}

/// The suspected parts, and the vertices of suspected faces that may be pinched.
Suspects suspects_of(const PolygonMesh& mesh, const Topology& topology, const SuspectedDefects& suspected,
                     const std::vector<Index>& labels, const Executor& exec)
{
    std::vector<std::uint8_t> is_corner(mesh.n_vertices(), 0);
    for_each(exec, static_cast<Index>(suspected.faces.size()), [&](Index i) {
        for (const Index v : mesh.face(suspected.faces[i]))
            std::atomic_ref(is_corner[v]).store(1, std::memory_order_relaxed);
    });
    // The members are set one by one: if memory runs out for a later member, GCC 12 destroys members made from {}
    // twice.
    Suspects suspects;
    suspects.parts = suspected.parts;
    suspects.vertices = select(exec, mesh.n_vertices(),
                               [&](Index v) { return is_corner[v] != 0 && may_be_pinched(mesh, topology, labels, v); });
    return suspects;
}

/// Repairs loose components and pinches in turn, because each may cause the other. Leaves all parts connected.
/// @returns whether no vertex is pinched any more.
bool mend_in_rounds(const PolygonMesh& mesh, const Topology& topology, Suspects found, std::vector<Index>& labels,
                    const Executor& exec)
{
    auto& suspects = found.parts;
    if (found.vertices.empty() && std::ranges::find(suspects, true) == suspects.end())
        return true;
    const auto n_labels = static_cast<Index>(suspects.size());
    PinchMender mender(mesh, topology, labels, n_labels);
    VertexQueue queue(mesh.n_vertices(), std::move(found.vertices));
    for (int round = 0;; ++round) {
        queue.add_corners_of(mesh, join_loose_components(mesh, topology, suspects, labels, exec));
        if (round == max_repair_rounds)
            return false;
        mender.count_faces(exec);
        std::vector<Index> moved;
        std::vector<Index> labels_before;
        for (const Index v : queue.take())
            mender.mend(v, moved, labels_before);
        if (moved.empty())
            return true;
        queue.add_corners_of(mesh, moved);
        suspects.assign(n_labels, false);
        for (const Index label : labels_before)
            suspects[label] = true;
    }
}

std::unique_ptr<Index[]> copy_of(const std::vector<Index>& labels, const Executor& exec)
{
    auto copy = uninitialised<Index>(labels.size());
    for_each(exec, static_cast<Index>(labels.size()), [&](Index f) { copy[f] = labels[f]; });
    return copy;
}

/// Repairs a cut and closes gaps in its labels.
/// @param suspects with one entry per label, each label within one component of the mesh.
/// @param before #F, the initial labels.
/// @returns the number of faces whose labels differ from the initial ones.
Index mend(const PolygonMesh& mesh, const Topology& topology, Suspects suspects, const Index* before,
           std::vector<Index>& labels, const Executor& exec)
{
    const auto n_labels = static_cast<Index>(suspects.parts.size());
    if (!mend_in_rounds(mesh, topology, std::move(suspects), labels, exec))
        merge_pinched(mesh, topology, n_labels, labels);
    const auto n_moved =
        static_cast<Index>(sum(exec, mesh.n_faces(), [&](Index f) { return labels[f] != before[f] ? 1.0 : 0.0; }));
    const auto n_faces = sums_by_value(
        exec, mesh.n_faces(), n_labels, [&](Index f) { return labels[f]; }, [](Index) { return 1; });
    if (std::ranges::find(n_faces, 0) != n_faces.end())
        compact_labels(labels);
    return n_moved;
}

}  // namespace

Index repair(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, const Executor& exec)
{
    Index n_labels = compact_labels(labels);
    const auto before = copy_of(labels, exec);
    n_labels = split_by_component(mesh, topology, n_labels, labels);
    return mend(mesh, topology, suspect_all(mesh, topology, n_labels, labels, exec), before.get(), labels, exec);
}

Index repair_within_components(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels,
                               const Executor& exec)
{
    const Index n_labels = compact_labels(labels);
    const auto before = copy_of(labels, exec);
    return mend(mesh, topology, suspect_all(mesh, topology, n_labels, labels, exec), before.get(), labels, exec);
}

Index repair_where_suspected(const PolygonMesh& mesh, const Topology& topology, const SuspectedDefects& suspected,
                             std::vector<Index>& labels, const Executor& exec)
{
    const auto before = copy_of(labels, exec);
    return mend(mesh, topology, suspects_of(mesh, topology, suspected, labels, exec), before.get(), labels, exec);
}

}  // namespace seamflow
