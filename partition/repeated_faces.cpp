#include "partition/repeated_faces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "partition/index_lists.h"

namespace seamflow {

std::vector<RepeatedFace> find_repeated_faces(const PolygonMesh& mesh, const std::vector<Index>& candidates)
{
    // The vertices of each candidate face, ascending.
    IndexLists vertices;
    for (const Index f : candidates) {
        const auto begin = static_cast<std::ptrdiff_t>(vertices.values.size());
        vertices.values.insert(vertices.values.end(), mesh.face(f).begin(), mesh.face(f).end());
        std::sort(vertices.values.begin() + begin, vertices.values.end());
        vertices.close();
    }
    std::vector<Index> order(candidates.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(
        order, [&](Index a, Index b) { return std::ranges::lexicographical_compare(vertices[a], vertices[b]); });
    std::vector<RepeatedFace> repeated;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i)
        if (std::ranges::equal(vertices[order[first]], vertices[order[i]]))
            repeated.push_back({candidates[order[i]], candidates[order[first]]});
        else
            first = i;
    std::ranges::sort(repeated, {}, &RepeatedFace::face);
    return repeated;
}

}  // namespace seamflow
