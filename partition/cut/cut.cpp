#include "partition/cut/cut.h"

#include <algorithm>
#include <numeric>

#include "partition/cut/compact.h"
#include "partition/cut/components.h"
#include "partition/cut/face_graph.h"
#include "partition/cut/metis.h"
#include "partition/cut/repair.h"
#include "partition/errors.h"
#include "partition/index.h"

namespace seamflow {

namespace {

std::string counted(Index n, const std::string& thing)
{
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

/// The faces of each connected component, ascending.
std::vector<std::vector<Index>> faces_by_component(const FaceComponents& components)
{
    std::vector<std::vector<Index>> faces(at(components.count));
    for (std::size_t f = 0; f < components.component.size(); ++f)
        faces[at(components.component[f])].push_back(static_cast<Index>(f));
    return faces;
}

/// Divides k among the components in proportion to their faces' corners less two (the weights METIS balances), by
/// largest remainders. Components that would go empty get one part on top, so that the others are cut as finely as k
/// asks however many small components there are.
std::vector<Index> share_out(const PolygonMesh& mesh, const std::vector<std::vector<Index>>& components, Index k)
{
    std::vector<double> due(components.size());
    for (std::size_t c = 0; c < components.size(); ++c)
        for (const Index f : components[c])
            due[c] += static_cast<double>(mesh.face(f).size()) - 2;
    const double total = std::accumulate(due.begin(), due.end(), 0.0);

    std::vector<Index> share(components.size());
    Index left = k;
    for (std::size_t c = 0; c < components.size(); ++c) {
        due[c] *= k / total;
        share[c] = static_cast<Index>(due[c]);
        left -= share[c];
    }
    std::vector<std::size_t> by_remainder(components.size());
    std::iota(by_remainder.begin(), by_remainder.end(), std::size_t{0});
    std::stable_sort(by_remainder.begin(), by_remainder.end(),
                     [&](std::size_t a, std::size_t b) { return due[a] - share[a] > due[b] - share[b]; });
    for (std::size_t i = 0; i < by_remainder.size() && left > 0; ++i, --left)
        ++share[by_remainder[i]];
    for (Index& parts : share)
        parts = std::max(Index{1}, parts);
    return share;
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
    const std::string number =
        "The mesh was cut into " + counted(cut.n_parts, "part") + " instead of " + std::to_string(k) + ", because ";
    if (cut.n_parts > k)
        cut.remarks.push_back(number + "it has " + counted(n_components, "connected component") +
                              " and a part cannot span several.");
    else if (sensible(mesh, k) < k)
        cut.remarks.push_back(number + "its " + counted(mesh.n_faces(), "face") +
                              " are too few for so many: a part should have about " +
                              std::to_string(min_faces_per_part) + " faces or more.");
    else
        cut.remarks.push_back(number + "some parts came out empty or were merged to make manifolds.");
}

Cut uncut(const PolygonMesh& mesh)
{
    Cut cut;
    cut.labels.assign(at(mesh.n_faces()), 0);
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
        throw InputError("there are " + std::to_string(labels.size()) + " labels for " +
                         counted(mesh.n_faces(), "face") + ": give one label for each face");
    const auto negative = std::find_if(labels.begin(), labels.end(), [](Index label) { return label < 0; });
    if (negative != labels.end())
        throw InputError("face " + std::to_string(negative - labels.begin()) + " (numbered from 0) has the label " +
                         std::to_string(*negative) + ": labels must be at least 0");
}

}  // namespace

Cut cut_into(const PolygonMesh& mesh, const Topology& topology, Index k)
{
    if (k < 1)
        throw OptionError("the number of parts is " + std::to_string(k) + ", but must be at least 1");
    if (k == 1 || mesh.n_faces() == 0)
        return uncut(mesh);
    const auto components = faces_by_component(face_components(mesh, topology));
    const auto share = share_out(mesh, components, sensible(mesh, k));

    Cut cut = uncut(mesh);
    FaceGraphMaker graphs(mesh, topology);
    Index first_label = 0;
    for (std::size_t c = 0; c < components.size(); ++c) {
        if (share[c] == 1) {
            for (const Index f : components[c])
                cut.labels[at(f)] = first_label;
        } else {
            const auto labels = metis_k_way(graphs.make(components[c]), share[c]);
            for (std::size_t i = 0; i < labels.size(); ++i)
                cut.labels[at(components[c][i])] = first_label + labels[i];
        }
        first_label += share[c];
    }
    cut.repaired_faces = repair(mesh, topology, cut.labels);
    cut.n_parts = count_parts(cut.labels);
    remark_on_number(mesh, k, static_cast<Index>(components.size()), cut);
    return cut;
}

Cut cut_by_labels(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels)
{
    require_labels(mesh, labels);
    Cut cut;
    cut.labels.assign(labels.begin(), labels.end());
    const Index largest = count_parts(cut.labels) - 1;
    const Index n_given = compact_labels(cut.labels);
    if (n_given > 0 && largest >= n_given)
        cut.remarks.push_back("The labels had gaps and were renumbered from 0 to " + std::to_string(n_given - 1) +
                              " in the same order.");
    if (n_given > 1)
        cut.repaired_faces = repair(mesh, topology, cut.labels);
    cut.n_parts = count_parts(cut.labels);
    if (cut.repaired_faces > 0)
        cut.remarks.push_back(counted(cut.repaired_faces, "face") +
                              " had to change parts so that every part is connected and a manifold with boundary.");
    if (cut.n_parts != n_given)
        cut.remarks.push_back("The labels name " + counted(n_given, "part") + "; after this there are " +
                              std::to_string(cut.n_parts) + ".");
    return cut;
}

}  // namespace seamflow
