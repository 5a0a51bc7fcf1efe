#include <algorithm>
#include <cmath>

#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

void append_edges(const IndexLists& faces, std::vector<VertexPair>& edges)
{
    for (Index f = 0; f < faces.size(); ++f) {
        const auto corners = faces[f];
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Index start = corners[k];
            const Index end = corners[k + 1 == corners.size() ? 0 : k + 1];
            edges.push_back({std::min(start, end), std::max(start, end)});
        }
    }
}

/// K has -1/‖e‖ for each edge, M_v the mean length of the edges at v.
class SymmetricFujiwara final : public SymmetricLaplacian {
  public:
    explicit SymmetricFujiwara(const FacesOnBothSides& faces)
        : inverse_degree_(at(faces.n_vertices), 0.0)
    {
        edges_.reserve(faces.own.values.size() + faces.beyond.values.size());
        append_edges(faces.own, edges_);
        append_edges(faces.beyond, edges_);
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        edges_.shrink_to_fit();
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
