#include "solvers/laplacian/symmetric_laplacian.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "partition/errors.h"
#include "solvers/laplacian/edge_lists.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// Calls assemble_with(add), where add(v, w, k, d) with k = factor · K_vw and d = V_w - V_v adds the pair's share of
/// the product, if that is wanted.
template <class AssembleWith>
void with_product(const StiffnessProduct* product, AssembleWith&& assemble_with)
{
    if (product == nullptr)
        return assemble_with([](Index, Index, double, const Point&) {});
    const Points& x = product->increments;
    Points& result = product->result;
    result.setZero();
    const auto add_with = [&](auto&& vector_of) {
        assemble_with([&](Index v, Index w, double entry, const Point& difference) {
            const Point change = entry * vector_of(difference, x.row(w) - x.row(v));
            result.row(v) += change;
            result.row(w) -= change;
        });
    };
    if (product->of_increments_alone)
        add_with([](const Point&, const Point& increment) -> Point { return increment; });
    else
        add_with([](const Point& difference, const Point& increment) -> Point { return difference + increment; });
}

/// K from edges. An edge on the boundary counts half, like one of its two half-edges.
/// @tparam Number of a vertex: as short as possible, because edges take much of a flow's memory.
template <EdgeKernel Kernel, class Number>
class SymmetricEdges final : public SymmetricLaplacian {
  public:
    SymmetricEdges(Kernel kernel, const FacesOnBothSides& faces)
        : kernel_(kernel)
        , inverse_degree_(faces.n_vertices, 0.0)
    {
        std::vector<VertexPair> edges;
        edges.reserve(faces.own.values.size() / 2 + faces.beyond.values.size());
        append_own_edges(faces, false, edges);
        const OuterEdges outer = list_outer_edges(faces);
        count_edges(edges, 1.0);
        count_edges(outer.inner, 1.0);
        count_edges(outer.rim, 0.5);
        for (double& degree : inverse_degree_)
            degree = degree > 0.0 ? (Kernel::averages_mass ? 1.0 / degree : 1.0) : 0.0;
        if (faces.contributions == Contributions::BothSides)
            edges.insert(edges.end(), outer.inner.begin(), outer.inner.end());
        n_whole_ = edges.size();
        if (faces.contributions == Contributions::BothSides)
            edges.insert(edges.end(), outer.rim.begin(), outer.rim.end());
        else
            append_own_edges(faces, true, edges);
        edges_.reserve(edges.size());
        for (const auto& [first, second] : edges)
            edges_.push_back({static_cast<Number>(first), static_cast<Number>(second)});
    }

    [[nodiscard]] bool uses_faces() const override { return false; }

    [[nodiscard]] std::vector<VertexPair> pairs() const override
    {
        std::vector<VertexPair> pairs;
        pairs.reserve(edges_.size());
        for (const auto& [first, second] : edges_)
            pairs.push_back({static_cast<Index>(first), static_cast<Index>(second)});
        return pairs;
    }

    void for_each_element(const std::function<void(std::size_t)>& action) const override
    {
        for (std::size_t i = 0; i < edges_.size(); ++i)
            action(1);
    }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct* product) override
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        with_product(product, [&](auto&& add_to_product) {
            const auto add = [&](std::size_t begin, std::size_t end, double share) {
                for (std::size_t i = begin; i < end; ++i) {
                    const auto [first, second] = edges_[i];
                    const Point difference = positions.row(second) - positions.row(first);
                    const auto edge = kernel_.edge(difference);
                    const double weight = edge.weight(share * factor);
                    add_to_product(first, second, -weight, difference);
                    values[slots[i]] -= weight;
                    for (const Number v : {first, second}) {
                        diagonal[v] += weight;
                        mass[v] += share * edge.mass();
                    }
                }
            };
            add(0, n_whole_, 1.0);
            add(n_whole_, edges_.size(), 0.5);
        });
        for (std::size_t v = 0; v < inverse_degree_.size(); ++v)
            mass[v] *= inverse_degree_[v];
    }

    void measure_mass(const Points& positions, std::span<double> mass) const override
    {
        std::fill(mass.begin(), mass.end(), 0.0);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const auto [first, second] = edges_[i];
            const auto edge = kernel_.edge(positions.row(second) - positions.row(first));
            const double share = (i < n_whole_ ? 1.0 : 0.5) * edge.mass();
            mass[first] += share;
            mass[second] += share;
        }
        for (std::size_t v = 0; v < inverse_degree_.size(); ++v)
            mass[v] *= inverse_degree_[v];
    }

  private:
    void count_edges(const std::vector<VertexPair>& edges, double share)
    {
        for (const VertexPair& e : edges) {
            inverse_degree_[e.first] += share;
            inverse_degree_[e.second] += share;
        }
    }

    struct Edge {
        Number first;
        Number second;
    };

    Kernel kernel_;
    /// First the edges that count fully, then those that count half.
    std::vector<Edge> edges_;
    std::size_t n_whole_ = 0;
    /// Per vertex: 1 / number of edges, those on the boundary counted half; 1 where M_v is a sum.
    std::vector<double> inverse_degree_;
};

/// K from faces.
template <FaceKernel Kernel>
class SymmetricFaces final : public SymmetricLaplacian {
  public:
    explicit SymmetricFaces(const FacesOnBothSides& faces)
        : lists_{faces.own}
    {
        if (faces.contributions == Contributions::BothSides)
            lists_.push_back(faces.beyond);
    }

    [[nodiscard]] bool uses_faces() const override { return true; }

    [[nodiscard]] std::vector<VertexPair> pairs() const override
    {
        std::vector<VertexPair> pairs;
        for (const IndexListsView& faces : lists_)
            for (Index f = 0; f < faces.size(); ++f) {
                const auto corners = faces[f];
                for (std::size_t i = 0; i < corners.size(); ++i)
                    for (std::size_t k = i + 1; k < corners.size(); ++k)
                        pairs.push_back({corners[i], corners[k]});
            }
        return pairs;
    }

    void for_each_element(const std::function<void(std::size_t)>& action) const override
    {
        for (const IndexListsView& faces : lists_)
            for (Index f = 0; f < faces.size(); ++f)
                action(faces[f].size() * (faces[f].size() - 1) / 2);
    }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct* product) override
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        const Index* slot = slots.data();
        with_product(product, [&](auto&& add_to_product) {
            const auto add = [&](const auto& face) {
                const double scale = factor / face.divisor();
                for (std::size_t i = 0; i < face.size(); ++i) {
                    const Index v = face.corner(i);
                    const auto row = face.row(i, scale);
                    diagonal[v] += row(i);
                    mass[v] += face.mass(i);
                    for (std::size_t k = i + 1; k < face.size(); ++k) {
                        const double coefficient = row(k);
                        add_to_product(v, face.corner(k), coefficient, face.difference(i, k));
                        values[*slot++] += coefficient;
                    }
                }
            };
            for (const IndexListsView& faces : lists_)
                for (Index f = 0; f < faces.size(); ++f)
                    measure_face<Kernel>(faces[f], positions, scratch_, add);
        });
    }

    void measure_mass(const Points& positions, std::span<double> mass) const override
    {
        std::fill(mass.begin(), mass.end(), 0.0);
        for (const IndexListsView& faces : lists_)
            for (Index f = 0; f < faces.size(); ++f) {
                const auto corners = faces[f];
                const double share = Kernel::corner_mass(Kernel::size(corners, positions), corners.size());
                for (const Index v : corners)
                    mass[v] += share;
            }
    }

  private:
    std::vector<IndexListsView> lists_;
    typename Kernel::Scratch scratch_;
};

/// As a fraction of K's diagonal times dt, below which a kept mass would be lost to rounding, and the place of a
/// component that is so small with it. More mass only delays its way to a point, which is the place of its centroid
/// either way.
constexpr double least_kept_mass = 1e-10;

/// K of certain positions, M of the same or of any.
class KeptStiffness final : public SymmetricLaplacian {
  public:
    KeptStiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices, const Points& positions,
                  bool keeps_mass)
        : laplacian_(std::move(laplacian))
        , pairs_(laplacian_->pairs())
        , diagonal_(n_vertices)
        , keeps_mass_(keeps_mass)
    {
        KeptStiffness::keep(positions);
    }

    void keep(const Points& positions) override
    {
        std::vector<Index> slots(pairs_.size());
        std::iota(slots.begin(), slots.end(), 0);
        std::vector<double> mass(diagonal_.size());
        entries_.assign(pairs_.size(), 0.0);
        laplacian_->assemble(positions, 1.0, slots, entries_, diagonal_, mass);
        if (keeps_mass_)
            mass_ = std::move(mass);
        unweighted_.clear();
    }

    void for_each_element(const std::function<void(std::size_t)>& action) const override
    {
        laplacian_->for_each_element(action);
    }

    void weigh(const SquaredDifference& squared_difference) override
    {
        if (unweighted_.empty())
            unweighted_ = entries_;
        std::ranges::fill(diagonal_, 0.0);
        std::size_t begin = 0;
        laplacian_->for_each_element([&](std::size_t n) {
            double largest = 0.0;
            for (std::size_t i = begin; i < begin + n; ++i)
                largest = std::max(largest, squared_difference(pairs_[i].first, pairs_[i].second));
            for (std::size_t i = begin; i < begin + n; ++i) {
                entries_[i] = unweighted_[i] / (1.0 + largest);
                diagonal_[pairs_[i].first] -= entries_[i];
                diagonal_[pairs_[i].second] -= entries_[i];
            }
            begin += n;
        });
    }

    [[nodiscard]] bool uses_faces() const override { return laplacian_->uses_faces(); }
    [[nodiscard]] std::vector<VertexPair> pairs() const override { return pairs_; }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct* product) override
    {
        measure_mass(positions, mass);
        for (std::size_t v = 0; v < diagonal_.size(); ++v) {
            diagonal[v] = factor * diagonal_[v];
            if (!mass_.empty())
                mass[v] = std::max(mass[v], least_kept_mass * diagonal[v]);
        }
        with_product(product, [&](auto&& add_to_product) {
            for (std::size_t i = 0; i < pairs_.size(); ++i) {
                const double entry = factor * entries_[i];
                const auto [v, w] = pairs_[i];
                add_to_product(v, w, entry, positions.row(w) - positions.row(v));
                values[slots[i]] += entry;
            }
        });
    }

    void measure_mass(const Points& positions, std::span<double> mass) const override
    {
        if (mass_.empty())
            laplacian_->measure_mass(positions, mass);
        else
            std::ranges::copy(mass_, mass.begin());
    }

  private:
    std::unique_ptr<SymmetricLaplacian> laplacian_;
    std::vector<VertexPair> pairs_;
    /// Per pair; and before they were weighed, if they are.
    std::vector<double> entries_;
    std::vector<double> unweighted_;
    /// Per vertex; M is empty if it follows the mesh.
    std::vector<double> diagonal_;
    std::vector<double> mass_;
    bool keeps_mass_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> keep_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices,
                                                   const Points& positions, bool keeps_mass)
{
    return std::make_unique<KeptStiffness>(std::move(laplacian), n_vertices, positions, keeps_mass);
}

std::unique_ptr<SymmetricLaplacian> make_symmetric_laplacian(const ScaledLaplacian& laplacian,
                                                             const FacesOnBothSides& faces)
{
    return with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) -> std::unique_ptr<SymmetricLaplacian> {
        if constexpr (EdgeKernel<Kernel>) {
            if (faces.n_vertices <= std::numeric_limits<std::uint16_t>::max())
                return std::make_unique<SymmetricEdges<Kernel, std::uint16_t>>(kernel, faces);
            return std::make_unique<SymmetricEdges<Kernel, Index>>(kernel, faces);
        } else if constexpr (FaceKernel<Kernel>)
            return std::make_unique<SymmetricFaces<Kernel>>(faces);
        else
            throw OptionError("the Laplacian is not symmetric");
    });
}

}  // namespace seamflow
