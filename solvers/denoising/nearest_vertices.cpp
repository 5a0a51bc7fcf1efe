#include "solvers/denoising/nearest_vertices.h"

#include <algorithm>

namespace seamflow {

std::span<const std::pair<double, Index>> NearestVertices::find(const IndexLists& neighbours, const Points& positions,
                                                                Index centre, std::size_t count)
{
    // Whole rings are searched until 1.5 times `count` vertices are found: the nearest vertices need not be in the
    // first rings.
    clear(8 * count);
    insert(centre);
    std::size_t first = 0;
    while (first < found_.size() && 2 * found_.size() < 3 * count)
        for (const std::size_t last = found_.size(); first < last; ++first)
            for (const Index w : neighbours[found_[first]])
                insert(w);
    nearest_.clear();
    for (const Index w : found_)
        nearest_.emplace_back((positions.row(w) - positions.row(centre)).squaredNorm(), w);
    const auto n = static_cast<std::ptrdiff_t>(std::min(count + 1, nearest_.size()));
    std::ranges::partial_sort(nearest_, nearest_.begin() + n);
    nearest_.resize(static_cast<std::size_t>(n));
    return nearest_;
}

void NearestVertices::clear(std::size_t n_slots)
{
    for (const std::size_t slot : used_)
        slots_[slot] = -1;
    used_.clear();
    found_.clear();
    if (slots_.size() < n_slots)
        slots_.assign(n_slots, -1);
}

void NearestVertices::insert(Index v)
{
    constexpr std::size_t multiplier = 2654435761U;
    // Half of the slots stay empty. Further vertices of rings around hubs, vertices of very many edges, are left out.
    if (2 * found_.size() >= slots_.size())
        return;
    std::size_t slot = static_cast<std::size_t>(v) * multiplier % slots_.size();
    while (slots_[slot] >= 0 && slots_[slot] != v)
        slot = slot + 1 < slots_.size() ? slot + 1 : 0;
    if (slots_[slot] == v)
        return;
    slots_[slot] = v;
    used_.push_back(slot);
    found_.push_back(v);
}

}  // namespace seamflow
