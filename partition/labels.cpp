#include "partition/labels.h"

#include <algorithm>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// compact_labels for labels so large that a table indexed by them would waste memory.
Index compact_sparse(std::vector<Index>& labels)
{
    std::vector<Index> distinct = labels;
    sort_unique(distinct);
    for (Index& label : labels)
        label = place_in(distinct, label);
    return static_cast<Index>(distinct.size());
}

}  // namespace

Index compact_labels(std::vector<Index>& labels)
{
    if (labels.empty())
        return 0;
    const auto largest = usize(*std::max_element(labels.begin(), labels.end()));
    if (largest > 4 * labels.size())
        return compact_sparse(labels);
    std::vector<Index> renumbered(largest + 1, -1);
    for (const Index label : labels)
        renumbered[label] = 0;
    Index count = 0;
    for (Index& r : renumbered)
        if (r == 0)
            r = count++;
    for (Index& label : labels)
        label = renumbered[label];
    return count;
}

void labels_around(const Topology& topology, std::span<const Index> labels, Index v, std::vector<Index>& found)
{
    found.clear();
    for (const Index corner : topology.corners_at(v))
        if (const Index label = labels[topology.face_of[corner]]; found.empty() || found.back() != label)
            found.push_back(label);
    if (found.size() > 1)
        sort_unique(found);
}

bool is_mixed(const Topology& topology, std::span<const Index> labels, Index v)
{
    const auto corners = topology.corners_at(v);
    return std::any_of(corners.begin(), corners.end(), [&](Index corner) {
        return labels[topology.face_of[corner]] != labels[topology.face_of[corners.front()]];
    });
}

std::vector<Index> mixed_vertices(const Topology& topology, std::span<const Index> labels, const Executor& exec)
{
    return select(exec, static_cast<Index>(topology.kind.size()),
                  [&](Index v) { return is_mixed(topology, labels, v); });
}

}  // namespace seamflow
