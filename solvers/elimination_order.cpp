#include "solvers/elimination_order.h"

#include <amd.h>
#include <camd.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

void require_ok(int status, int ok)
{
    if (status < ok)
        throw ComputationError("out of memory in the analysis of the system: use more sub-meshes");
}

}  // namespace

std::vector<Index> elimination_order(const SparsePattern& upper)
{
    std::vector<Index> order(at(upper.n()));
    if (!order.empty())
        require_ok(amd_order(upper.n(), upper.column_offsets.data(), upper.rows.data(), order.data(), nullptr, nullptr),
                   AMD_OK);
    return order;
}

std::vector<Index> elimination_order(const SparsePattern& upper, const std::vector<bool>& is_last)
{
    // CAMD has as many groups as there are unknowns at most: a single one cannot be in the second.
    if (is_last.size() < 2)
        return elimination_order(upper);
    std::vector<Index> order(is_last.size());
    const std::vector<Index> groups(is_last.begin(), is_last.end());
    require_ok(camd_order(upper.n(), upper.column_offsets.data(), upper.rows.data(), order.data(), nullptr, nullptr,
                          groups.data()),
               CAMD_OK);
    return order;
}

}  // namespace seamflow
