#include "solvers/laplacian/edge_lists.h"

#include <algorithm>

namespace seamflow {

namespace {

/// Calls action(h, start, end) for every half-edge h.
template <class Action>
void for_each_halfedge(const IndexListsView& faces, Action&& action)
{
    for (Index f = 0; f < faces.size(); ++f) {
        const auto corners = faces[f];
        for (std::size_t k = 0; k < corners.size(); ++k)
            action(usize(faces.offsets[f]) + k, corners[k], corners[k + 1 == corners.size() ? 0 : k + 1]);
    }
}

/// Sorts edges by their numbers of faces, in ascending order.
OuterEdges by_number_of_faces(const std::vector<VertexPair>& edges, Index n_vertices)
{
    IndexLists seconds = make_lists(n_vertices, [&](auto&& add) {
        for (const VertexPair& e : edges)
            add(e.first, e.second);
    });
    OuterEdges outer;
    auto second = seconds.values.begin();
    for (Index first = 0; first < n_vertices; ++first) {
        const auto end = seconds.values.begin() + seconds.offsets[first + 1];
        std::sort(second, end);
        while (second != end) {
            const auto next = std::find_if(second, end, [&](Index v) { return v != *second; });
            outer.inner.insert(outer.inner.end(), usize(static_cast<Index>(next - second) / 2), {first, *second});
            if ((next - second) % 2 != 0)
                outer.rim.push_back({first, *second});
            second = next;
        }
    }
    return outer;
}

}  // namespace

OuterEdges list_outer_edges(const FacesOnBothSides& faces)
{
    std::vector<VertexPair> edges;
    const auto add = [&](Index start, Index end) { edges.push_back({std::min(start, end), std::max(start, end)}); };
    for_each_halfedge(faces.own, [&](std::size_t h, Index start, Index end) {
        if (faces.twin[h] < 0)
            add(start, end);
    });
    for_each_halfedge(faces.beyond, [&](std::size_t, Index start, Index end) { add(start, end); });
    return by_number_of_faces(edges, faces.n_vertices);
}

void append_own_edges(const FacesOnBothSides& faces, bool on_rim, std::vector<VertexPair>& edges)
{
    for_each_halfedge(faces.own, [&](std::size_t h, Index start, Index end) {
        const Index twin = faces.twin[h];
        if ((twin < 0) == on_rim && (twin < 0 || h < usize(twin)))
            edges.push_back({start, end});
    });
}

}  // namespace seamflow
