#include "partition/repair/merge.h"

#include <numeric>

#include "partition/labels.h"
#include "partition/repair/pinches.h"

namespace seamflow {

namespace {

/// Follows a chain of merged labels to its end.
Index merged_into(std::vector<Index>& parent, Index label)
{
    while (parent[label] != label) {
        parent[label] = parent[parent[label]];
        label = parent[label];
    }
    return label;
}

}  // namespace

void merge_pinched(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels)
{
    PinchMender mender(mesh, topology, labels, n_labels);
    std::vector<Index> vertices = mixed_vertices(topology, labels);
    std::vector<Index> parent(n_labels);
    std::iota(parent.begin(), parent.end(), 0);
    for (bool merged = true; merged;) {
        merged = false;
        mender.count_faces();
        std::erase_if(vertices, [&](Index v) { return !is_mixed(topology, labels, v); });
        for (const Index v : vertices) {
            if (mender.pinches_at(v) == 0)
                continue;
            const auto [larger, smaller] = mender.pinched_and_between(v);
            const Index root = merged_into(parent, larger);
            parent[merged_into(parent, smaller)] = root;
            merged = true;
        }
        for (Index& label : labels)
            label = merged_into(parent, label);
    }
}

}  // namespace seamflow
