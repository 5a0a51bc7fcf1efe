#include "partition/cut/cut.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "partition/cut/clusters.h"
#include "partition/cut/divide.h"
#include "partition/cut/face_graph.h"
#include "partition/cut/refine.h"
#include "partition/cut/seams.h"
#include "partition/errors.h"
#include "partition/labels.h"
#include "partition/repair/repair.h"

namespace seamflow {

namespace {

std::string counted(Index n, std::string_view thing)
{
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

/// Lighter meshes (see face_weight) are divided face by face, which takes a fraction of a second and gives the best
/// seams; of others clusters are.
constexpr double min_weight_for_clusters = 500'000;
/// With parts as small as this, seams matter less, and clusters are grown in lighter meshes too.
constexpr double small_part = 5'000;
constexpr double min_weight_for_small_parts = 300'000;
/// How many clusters METIS gets for a part, about: enough to shape it well and to balance parts within a few percent.
constexpr double clusters_per_part = 80;
/// And in all, which takes a twentieth of a second.
constexpr double min_clusters = 20'000;
/// Larger clusters save no time and leave longer seams.
constexpr double max_cluster_weight = 64;
/// Smaller clusters save little against single faces.
constexpr double min_cluster_weight = 8;
/// Where a part would have fewer clusters than this, METIS gets every face.
constexpr double min_clusters_per_part = 30;

/// How much a cluster should weigh when a mesh is cut into k parts.
Index cluster_weight(const PolygonMesh& mesh, Index k)
{
    const double total = static_cast<double>(mesh.n_corners()) - 2.0 * mesh.n_faces();
    if (total < (total / k <= small_part ? min_weight_for_small_parts : min_weight_for_clusters))
        return 1;
    if (total / k < min_clusters_per_part * min_cluster_weight)
        return 1;
    return static_cast<Index>(
        std::clamp(total / std::max(k * clusters_per_part, min_clusters), min_cluster_weight, max_cluster_weight));
}

/// The largest sensible number of parts of a mesh, k at most.
Index sensible(const PolygonMesh& mesh, Index k)
{
    return std::clamp(mesh.n_faces() / min_faces_per_part, Index{1}, k);
}

void remark_on_number(const PolygonMesh& mesh, Index k, Index n_components, Cut& cut)
{
    if (cut.n_parts == k)
        return;
    std::string reason = "some parts came out empty or were merged to make manifolds";
    if (cut.n_parts > k)
        reason = fmt::format("it has {} and a part cannot span several", counted(n_components, "connected component"));
    else if (sensible(mesh, k) < k)
        reason = fmt::format("its {} are too few for so many: a part should have about {} faces or more",
                             counted(mesh.n_faces(), "face"), min_faces_per_part);
    cut.remarks.push_back(
        fmt::format("The mesh was cut into {} instead of {}, because {}.", counted(cut.n_parts, "part"), k, reason));
}

Cut uncut(const PolygonMesh& mesh)
{
    Cut cut;
    cut.labels.assign(mesh.n_faces(), 0);
    cut.n_parts = mesh.n_faces() > 0 ? 1 : 0;
    return cut;
}

Index count_parts(const std::vector<Index>& labels)
{
    return labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1;
}

void require_labels(const PolygonMesh& mesh, std::span<const Index> labels)
{
    if (labels.size() != at(mesh.n_faces()))
        throw InputError(fmt::format("there are {} labels for {}: give one label for each face", labels.size(),
                                     counted(mesh.n_faces(), "face")));
    const auto negative = std::find_if(labels.begin(), labels.end(), [](Index label) { return label < 0; });
    if (negative != labels.end())
        throw InputError(fmt::format("face {} (numbered from 0) has the label {}: labels must be at least 0",
                                     negative - labels.begin(), *negative));
}

}  // namespace

Cut cut_into(const PolygonMesh& mesh, const Topology& topology, Index k, const Loop& loop, const Alongside& alongside)
{
    if (k < 1)
        throw OptionError(fmt::format("the number of parts is {}, but must be at least 1", k));
    if (k == 1 || mesh.n_faces() == 0)
        return uncut(mesh);
    const Index n_parts = sensible(mesh, k);
    const Index weight = cluster_weight(mesh, n_parts);
    FaceClusters clusters = grow_clusters(mesh, topology, weight, loop);
    const auto measure = weight > 1 ? ArcMeasure::Count : ArcMeasure::Length;
    const FaceGraph graph = make_face_graph(mesh, topology, clusters, measure, loop);
    const auto afterwards = weight > 1 ? Afterwards::Refined : Afterwards::Nothing;
    Components components;
    std::vector<Index> part;
    alongside([&] {
        components = graph_components(graph);
        part = divide(graph, components, n_parts, afterwards);
        if (weight > 1)
            refine(graph, count_parts(part), part);
    });

    const Index n_labels = compact_labels(part);
    Cut cut;
    cut.labels = std::move(clusters.cluster_of);
    for_each(loop, mesh.n_faces(), [&](Index f) { cut.labels[f] = part[cut.labels[f]]; });
    if (weight > 1) {
        const SuspectedDefects suspected = shorten_seams(mesh, topology, n_labels, cut.labels, loop);
        cut.repaired_faces = repair_where_suspected(mesh, topology, suspected, cut.labels, loop);
    } else {
        cut.repaired_faces = repair_within_components(mesh, topology, cut.labels, loop);
    }
    cut.n_parts = count_parts(cut.labels);
    remark_on_number(mesh, k, components.count(), cut);
    return cut;
}

Cut cut_by_labels(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, const Loop& loop)
{
    require_labels(mesh, labels);
    Cut cut;
    cut.labels.assign(labels.begin(), labels.end());
    const Index largest = count_parts(cut.labels) - 1;
    const Index n_given = compact_labels(cut.labels);
    if (n_given > 0 && largest >= n_given)
        cut.remarks.push_back(
            fmt::format("The labels had gaps and were renumbered from 0 to {} in the same order.", n_given - 1));
    if (n_given > 1)
        cut.repaired_faces = repair(mesh, topology, cut.labels, loop);
    cut.n_parts = count_parts(cut.labels);
    if (cut.repaired_faces > 0)
        cut.remarks.push_back(counted(cut.repaired_faces, "face") +
                              " had to change parts so that every part is connected and a manifold with boundary.");
    if (cut.n_parts != n_given)
        cut.remarks.push_back(
            fmt::format("The labels name {}; after this there are {}.", counted(n_given, "part"), cut.n_parts));
    return cut;
}

}  // namespace seamflow
