#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Edges by the number of faces that they have here.
struct OuterEdges {
    /// Of several faces.
    std::vector<VertexPair> inner;
    /// Of one face. Those at a vertex that may move are on the boundary of the whole mesh.
    std::vector<VertexPair> rim;
};

/// Each of them once, in ascending order.
OuterEdges by_number_of_faces(const std::vector<VertexPair>& edges, Index n_vertices)
{
    // By first vertices: where those of each begin, which moves on to where they end.
    std::vector<Index> ends(at(n_vertices) + 1, 0);
    for (const VertexPair& e : edges)
        ++ends[at(e.first) + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Index> seconds(edges.size());
    for (const VertexPair& e : edges)
        seconds[at(ends[at(e.first)]++)] = e.second;
    OuterEdges outer;
    auto second = seconds.begin();
    for (Index first = 0; first < n_vertices; ++first) {
        const auto end = seconds.begin() + ends[at(first)];
        std::sort(second, end);
        while (second != end) {
            const auto next = std::find_if(second, end, [&](Index v) { return v != *second; });
            (next - second == 1 ? outer.rim : outer.inner).push_back({first, *second});
            second = next;
        }
    }
    return outer;
}

/// The edges of own faces on the rim of the sub-mesh, and all edges of the faces beyond.
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

/// The edges between two own faces, or those on the rim, each once.
void append_own_edges(const FacesOnBothSides& faces, bool on_rim, std::vector<VertexPair>& edges)
{
    for_each_halfedge(faces.own, [&](std::size_t h, Index start, Index end) {
        const Index twin = faces.twin[h];
        if ((twin < 0) == on_rim && (twin < 0 || h < at(twin)))
            edges.push_back({start, end});
    });
}

/// K has -1/‖e‖ for each edge, M_v the mean length of the edges at v. Half of an edge on the boundary counts, as one of
/// its two half-edges does.
class SymmetricFujiwara final : public SymmetricLaplacian {
  public:
    explicit SymmetricFujiwara(const FacesOnBothSides& faces)
        : inverse_degree_(at(faces.n_vertices), 0.0)
    {
        edges_.reserve(faces.own.values.size() / 2 + faces.beyond.values.size());
        append_own_edges(faces, false, edges_);
        const OuterEdges outer = list_outer_edges(faces);
        count_edges(edges_, 1.0);
        count_edges(outer.inner, 1.0);
        count_edges(outer.rim, 0.5);
        for (double& degree : inverse_degree_)
            degree = degree > 0.0 ? 1.0 / degree : 0.0;
        if (faces.contributions == Contributions::BothSides)
            edges_.insert(edges_.end(), outer.inner.begin(), outer.inner.end());
        n_whole_ = edges_.size();
        if (faces.contributions == Contributions::BothSides)
            edges_.insert(edges_.end(), outer.rim.begin(), outer.rim.end());
        else
            append_own_edges(faces, true, edges_);
        edges_.shrink_to_fit();
    }

    [[nodiscard]] bool uses_faces() const override { return false; }

    [[nodiscard]] std::vector<VertexPair> pairs() const override { return edges_; }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, Points* product) override
    {
        if (product != nullptr) {
            product->setZero();
            assemble_with(positions, factor, slots, values, diagonal, mass,
                          [&](const VertexPair& e, const Point& flux) {
                              product->row(e.first) -= flux;
                              product->row(e.second) += flux;
                          });
        } else {
            assemble_with(positions, factor, slots, values, diagonal, mass, [](const VertexPair&, const Point&) {});
        }
    }

  private:
    /// Calls add_flux(edge, factor · (-K) times the difference of its ends).
    template <class AddFlux>
    void assemble_with(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                       std::span<double> diagonal, std::span<double> mass, AddFlux&& add_flux) const
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        const auto add = [&](std::size_t begin, std::size_t end, double share) {
            for (std::size_t i = begin; i < end; ++i) {
                const VertexPair& e = edges_[i];
                const Point difference = positions.row(e.second) - positions.row(e.first);
                const double length = difference.norm();
                const double weight = share * factor / length;
                add_flux(e, weight * difference);
                values[at(slots[i])] -= weight;
                diagonal[at(e.first)] += weight;
                diagonal[at(e.second)] += weight;
                mass[at(e.first)] += share * length;
                mass[at(e.second)] += share * length;
            }
        };
        add(0, n_whole_, 1.0);
        add(n_whole_, edges_.size(), 0.5);
        for (std::size_t v = 0; v < inverse_degree_.size(); ++v)
            mass[v] *= inverse_degree_[v];
    }

    void count_edges(const std::vector<VertexPair>& edges, double share)
    {
        for (const VertexPair& e : edges) {
            inverse_degree_[at(e.first)] += share;
            inverse_degree_[at(e.second)] += share;
        }
    }

    /// First those that count whole, then those of which half counts.
    std::vector<VertexPair> edges_;
    std::size_t n_whole_ = 0;
    /// Per vertex: 1 / number of edges, those on the boundary counted half.
    std::vector<double> inverse_degree_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> make_symmetric_fujiwara(const FacesOnBothSides& faces)
{
    return std::make_unique<SymmetricFujiwara>(faces);
}

}  // namespace seamflow
