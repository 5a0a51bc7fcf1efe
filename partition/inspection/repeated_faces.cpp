#include "partition/inspection/repeated_faces.h"

#include <algorithm>
#include <numeric>

#include "partition/index_lists.h"

namespace seamflow {

std::vector<RepeatedFace> find_repeated_faces(const PolygonMesh& mesh, const std::vector<Index>& candidates)
{
    // The vertices of each candidate, ascending.
    IndexLists vertices;
    for (const Index f : candidates) {
        const auto begin = static_cast<std::ptrdiff_t>(vertices.values.size());
        vertices.values.insert(vertices.values.end(), mesh.face(f).begin(), mesh.face(f).end());
        std::sort(vertices.values.begin() + begin, vertices.values.end());
        vertices.close();
    }
    std::vector<Index> order(candidates.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const auto [x, y] = std::ranges::mismatch(vertices[a], vertices[b]);
        if (x == vertices[a].end() || y == vertices[b].end())
            return vertices[a].size() != vertices[b].size() ? vertices[a].size() < vertices[b].size() : a < b;
        return *x < *y;
    });
    std::vector<RepeatedFace> repeated;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
        if (std::ranges::equal(vertices[order[first]], vertices[order[i]]))
            repeated.push_back({candidates[order[i]], candidates[order[first]]});
        else
            first = i;
    }
    std::sort(repeated.begin(), repeated.end(),
              [](const RepeatedFace& a, const RepeatedFace& b) { return a.face < b.face; });
    return repeated;
}

}  // namespace seamflow
