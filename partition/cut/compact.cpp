#include "partition/cut/compact.h"

#include <algorithm>

#include "partition/cut/at.h"

namespace seamflow
{

namespace
{

/// Labels so large that a table of them would waste memory.
Index compact_sparse(std::vector<Index>& labels)
{
    std::vector<Index> distinct = labels;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (Index& label : labels)
        label = static_cast<Index>(std::lower_bound(distinct.begin(), distinct.end(), label) - distinct.begin());
    return static_cast<Index>(distinct.size());
}

}  // namespace

Index compact_labels(std::vector<Index>& labels)
{
    if (labels.empty())
        return 0;
    const auto largest = at(*std::max_element(labels.begin(), labels.end()));
    if (largest > 4 * labels.size())
        return compact_sparse(labels);
    std::vector<Index> renumbered(largest + 1, -1);
    for (const Index label : labels)
        renumbered[at(label)] = 0;
    Index count = 0;
    for (Index& r : renumbered)
        if (r == 0)
            r = count++;
    for (Index& label : labels)
        label = renumbered[at(label)];
    return count;
}

}  // namespace seamflow
