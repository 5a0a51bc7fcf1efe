#include <algorithm>
#include <cmath>

#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

/// Calls action(h, start, end) for every half-edge h.
template <class Action>
void for_each_halfedge(const IndexLists& faces, Action&& action)
{
    for (Index f = 0; f < faces.size(); ++f) {
        const auto corners = faces[f];
        for (std::size_t k = 0; k < corners.size(); ++k)
            action(at(faces.offsets[at(f)]) + k, corners[k], corners[k + 1 == corners.size() ? 0 : k + 1]);
    }
}

/// Every edge once. Those along Γ belong to faces on both sides.
std::vector<VertexPair> list_edges(const FacesOnBothSides& faces)
{
    std::vector<VertexPair> edges;
    edges.reserve(faces.own.values.size() / 2 + faces.beyond.values.size());
    std::vector<VertexPair> on_rim;
    const auto add_to_rim = [&](Index start, Index end) {
        on_rim.push_back({std::min(start, end), std::max(start, end)});
    };
    for_each_halfedge(faces.own, [&](std::size_t h, Index start, Index end) {
        const Index twin = faces.twin[h];
        if (twin < 0)
            add_to_rim(start, end);
        else if (h < at(twin))
            edges.push_back({start, end});
    });
    for_each_halfedge(faces.beyond, [&](std::size_t, Index start, Index end) { add_to_rim(start, end); });
    std::sort(on_rim.begin(), on_rim.end());
    on_rim.erase(std::unique(on_rim.begin(), on_rim.end()), on_rim.end());
    edges.insert(edges.end(), on_rim.begin(), on_rim.end());
    edges.shrink_to_fit();
    return edges;
}

/// K has -1/‖e‖ for each edge, M_v the mean length of the edges at v.
class SymmetricFujiwara final : public SymmetricLaplacian {
  public:
    explicit SymmetricFujiwara(const FacesOnBothSides& faces)
        : edges_(list_edges(faces))
        , inverse_degree_(at(faces.n_vertices), 0.0)
    {
        for (const VertexPair& e : edges_) {
            inverse_degree_[at(e.first)] += 1.0;
            inverse_degree_[at(e.second)] += 1.0;
        }
        for (double& degree : inverse_degree_)
            degree = degree > 0.0 ? 1.0 / degree : 0.0;
    }

    [[nodiscard]] std::vector<VertexPair> pairs() const override { return edges_; }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass) override
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const auto [start, end] = edges_[i];
            const double length = (positions.row(end) - positions.row(start)).norm();
            const double weight = factor / length;
            values[at(slots[i])] -= weight;
            diagonal[at(start)] += weight;
            diagonal[at(end)] += weight;
            mass[at(start)] += length;
            mass[at(end)] += length;
        }
        for (std::size_t v = 0; v < inverse_degree_.size(); ++v)
            mass[v] *= inverse_degree_[v];
    }

  private:
    std::vector<VertexPair> edges_;
    /// Per vertex: 1 / number of edges.
    std::vector<double> inverse_degree_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> make_symmetric_fujiwara(const FacesOnBothSides& faces)
{
    return std::make_unique<SymmetricFujiwara>(faces);
}

}  // namespace seamflow
