#include "partition/cut/cut_into.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "partition/cut/clusters.h"
#include "partition/cut/divide.h"
#include "partition/cut/face_graph.h"
#include "partition/cut/part_boundaries.h"
#include "partition/cut/refine.h"
#include "partition/errors.h"
#include "partition/labels.h"
#include "partition/large_arrays.h"
#include "partition/repair/repair.h"

namespace seamflow {

namespace {

std::string number_of(std::int64_t n, std::string_view thing)
{
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

/// The mesh as one part; no part if it has no faces.
Cut uncut(const PolygonMesh& mesh)
{
    Cut cut;
    cut.labels = large_vector<Index>(usize(mesh.n_faces()));
    cut.n_parts = mesh.n_faces() > 0 ? 1 : 0;
    return cut;
}

/// One more than the highest label; 0 without labels.
Index count_parts(const std::vector<Index>& labels)
{
    return labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1;
}

void require_labels(const PolygonMesh& mesh, std::span<const Index> labels)
{
    if (labels.size() != usize(mesh.n_faces()))
        throw InputError(fmt::format("there are {} labels for {}: give one label for each face", labels.size(),
                                     number_of(mesh.n_faces(), "face")));
    const auto negative = std::find_if(labels.begin(), labels.end(), [](Index label) { return label < 0; });
    if (negative != labels.end())
        throw InputError(fmt::format("face {} (numbered from 0) has the label {}: labels must be at least 0",
                                     negative - labels.begin(), *negative));
}

/// The fewest faces of a part on average: a part should have vertices that no other part has.
constexpr Index min_faces_per_part = 12;

/// The largest sensible number of parts of a mesh of n_faces faces, at most k.
Index sensible_parts(std::int64_t n_faces, Index k)
{
    return static_cast<Index>(std::clamp<std::int64_t>(n_faces / min_faces_per_part, 1, k));
}

/// A remark on why a mesh was not cut into k parts; nothing if it was.
std::optional<Remark> remark_on_number(std::int64_t n_faces, Index k, Index n_parts, Index n_components)
{
    if (n_parts == k)
        return {};
    std::string reason = "some parts came out empty or were merged to make manifolds";
    if (n_parts > k)
        reason =
            fmt::format("it has {} and a part cannot span several", number_of(n_components, "connected component"));
    else if (sensible_parts(n_faces, k) < k)
        reason = fmt::format("its {} are too few for so many: a part should have about {} faces or more",
                             number_of(n_faces, "face"), min_faces_per_part);
    return Remark(
        "number of parts", {{"parts", n_parts}, {"asked", k}},
        {fmt::format("The mesh was cut into {} instead of {}, because {}.", number_of(n_parts, "part"), k, reason)});
}

/// Remarks on given labels, one sentence each.
/// @param n_given the number of different labels. @param largest the largest of them.
std::vector<Remark> remarks_on_labels(Index n_given, Index largest, std::int64_t repaired_faces, Index n_parts)
{
    std::vector<Remark> remarks;
    if (n_given > 0 && largest >= n_given)
        remarks.push_back(
            {"gaps in labels",
             {{"labels", n_given}},
             {fmt::format("The labels had gaps and were renumbered from 0 to {} in the same order.", n_given - 1)}});
    if (repaired_faces > 0)
        remarks.push_back({"repaired parts",
                           {{"faces", repaired_faces}},
                           {number_of(repaired_faces, "face") +
                            " had to change parts so that every part is connected and a manifold with boundary."}});
    if (n_parts != n_given)
        remarks.push_back(
            {"number of parts",
             {{"parts", n_parts}, {"asked", n_given}},
             {fmt::format("The labels name {}; now there are {}.", number_of(n_given, "part"), n_parts)}});
    return remarks;
}

}  // namespace

Cut cut_into(const PolygonMesh& mesh, const Topology& topology, Index k, const Executor& exec,
             const Alongside& alongside)
{
    if (k < 1)
        throw OptionError(fmt::format("the number of parts is {}, but must be at least 1", k));
    if (k == 1 || mesh.n_faces() == 0)
        return uncut(mesh);
    const Index n_parts = sensible_parts(mesh.n_faces(), k);
    // The number of corners - 2 per face is the sum of face_weight.
    const Index weight = cluster_weight(static_cast<double>(mesh.n_corners()) - 2.0 * mesh.n_faces(), n_parts);
    FaceClusters clusters = grow_clusters(mesh, topology, weight, exec);
    const auto measure = weight > 1 ? ArcMeasure::Count : ArcMeasure::Length;
    const FaceGraph graph = make_face_graph(mesh, topology, clusters, measure, exec);
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
    // The label of a face is the part of its cluster.
    cut.labels = std::move(clusters.cluster_of);
    for_each(exec, mesh.n_faces(), [&](Index f) { cut.labels[f] = part[cut.labels[f]]; });
    if (weight > 1) {
        const SuspectedDefects suspected = shorten_boundaries(mesh, topology, n_labels, cut.labels, exec);
        cut.repaired_faces = repair_where_suspected(mesh, topology, suspected, cut.labels, exec);
    } else {
        cut.repaired_faces = repair_within_components(mesh, topology, cut.labels, exec);
    }
    cut.n_parts = count_parts(cut.labels);
    if (const auto remark = remark_on_number(mesh.n_faces(), k, cut.n_parts, components.count()))
        cut.remarks.push_back(*remark);
    return cut;
}

Cut cut_by_labels(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                  const Executor& exec)
{
    require_labels(mesh, labels);
    Cut cut;
    cut.labels.assign(labels.begin(), labels.end());
    const Index largest = count_parts(cut.labels) - 1;
    const Index n_given = compact_labels(cut.labels);
    if (n_given > 1)
        cut.repaired_faces = repair(mesh, topology, cut.labels, exec);
    cut.n_parts = count_parts(cut.labels);
    cut.remarks = remarks_on_labels(n_given, largest, cut.repaired_faces, cut.n_parts);
    return cut;
}

}  // namespace seamflow
