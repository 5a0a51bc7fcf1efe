#include "solvers/laplacian/symmetric_laplacian.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "partition/errors.h"
#include "solvers/laplacian/edge_lists.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// K as a sum over edges. An edge on the boundary counts half, like one of its two half-edges.
/// @tparam Number the type of vertex numbers: as short as possible, because edges take much of a flow's memory.
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
    /// Adds to the degrees of vertices, which inverse_degree_ holds at first.
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
    /// First the n_whole_ edges that count fully, then the edges that count half.
    std::vector<Edge> edges_;
    std::size_t n_whole_ = 0;
    /// Per vertex: 1 / number of edges, edges on the boundary counting half; 1 if M_v is a sum and not a mean.
    std::vector<double> inverse_degree_;
};

/// K as a sum over faces.
template <FaceKernel Kernel>
class SymmetricFaces final : public SymmetricLaplacian {
  public:
    SymmetricFaces(const FacesOnBothSides& faces, std::size_t most_corners)
        : lists_{faces.own}
        , n_vertices_(faces.n_vertices)
        , most_corners_(most_corners)
    {
        if (faces.contributions == Contributions::BothSides)
            lists_.push_back(faces.beyond);
        for (Index f = 0; f < faces.own.size(); ++f)
            n_auxiliary_ += has_auxiliary(lists_[0], faces.own[f]) ? n_of_face : 0;
    }

    [[nodiscard]] bool uses_faces() const override { return true; }

    [[nodiscard]] Index n_auxiliary() const override { return n_auxiliary_; }

    [[nodiscard]] std::vector<VertexPair> pairs() const override
    {
        std::vector<VertexPair> pairs;
        Index auxiliary = n_vertices_;
        for (const IndexListsView& faces : lists_)
            for (Index f = 0; f < faces.size(); ++f) {
                const auto corners = faces[f];
                if (has_auxiliary(faces, corners)) {
                    for (std::size_t i = 0; i < corners.size(); ++i)
                        pairs.push_back({corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]});
                    for (Index j = 0; j < n_of_face; ++j, ++auxiliary)
                        for (const Index v : corners)
                            pairs.push_back({v, auxiliary});
                    continue;
                }
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
                action(has_auxiliary(faces, faces[f]) ? faces[f].size() * (1 + usize(n_of_face))
                                                      : faces[f].size() * (faces[f].size() - 1) / 2);
    }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct* product) override
    {
        std::fill(diagonal.begin(), diagonal.end(), 0.0);
        std::fill(mass.begin(), mass.end(), 0.0);
        const Index* slot = slots.data();
        Index auxiliary = n_vertices_;
        with_product(product, [&](auto&& add_to_product) {
            const auto add_with_auxiliary = [&](const auto& face) {
                const std::size_t n = face.size();
                for (std::size_t i = 0; i < n; ++i) {
                    const std::size_t next = i + 1 == n ? 0 : i + 1;
                    const RingEntries ring = face.ring(i);
                    diagonal[face.corner(i)] += factor * ring.here;
                    mass[face.corner(i)] += face.mass(i);
                    add_to_product(face.corner(i), face.corner(next), factor * ring.to_next, face.difference(i, next));
                    values[*slot++] += factor * ring.to_next;
                }
                const auto divisors = face.auxiliary();
                for (std::size_t j = 0; j < divisors.size(); ++j, ++auxiliary) {
                    diagonal[auxiliary] = factor * divisors[j];
                    const auto entry = [&](std::size_t i) { return factor * face.coupling(i)[j]; };
                    for (std::size_t i = 0; i < n; ++i)
                        values[*slot++] += entry(i);
                    if (product != nullptr)
                        add_auxiliary(
                            *product, positions, n, [&](std::size_t i) { return face.corner(i); }, entry,
                            diagonal[auxiliary]);
                }
            };
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
                    if (has_auxiliary(faces, faces[f]))
                        add_with_auxiliary(
                            Kernel::polygon(faces[f], positions, Kernel::size(faces[f], positions), scratch_));
                    else
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
    using LargeFace =
        decltype(Kernel::polygon({}, std::declval<const Points&>(), 0.0, std::declval<typename Kernel::Scratch&>()));
    /// The number of auxiliary unknowns of a face that has any.
    static constexpr Index n_of_face =
        static_cast<Index>(std::tuple_size_v<decltype(std::declval<LargeFace>().auxiliary())>);

    /// Whether a face gets auxiliary unknowns. Faces beyond Γ do not: other sub-meshes need their entries.
    [[nodiscard]] bool has_auxiliary(const IndexListsView& of, std::span<const Index> corners) const
    {
        return corners.size() > most_corners_ && &of == lists_.data();
    }

    std::vector<IndexListsView> lists_;
    Index n_vertices_;
    std::size_t most_corners_;
    Index n_auxiliary_ = 0;
    typename Kernel::Scratch scratch_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> make_symmetric_laplacian(const ScaledLaplacian& laplacian,
                                                             const FacesOnBothSides& faces, std::size_t most_corners)
{
    return with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) -> std::unique_ptr<SymmetricLaplacian> {
        if constexpr (EdgeKernel<Kernel>) {
            if (faces.n_vertices <= std::numeric_limits<std::uint16_t>::max())
                return std::make_unique<SymmetricEdges<Kernel, std::uint16_t>>(kernel, faces);
            return std::make_unique<SymmetricEdges<Kernel, Index>>(kernel, faces);
        } else if constexpr (FaceKernel<Kernel>)
            return std::make_unique<SymmetricFaces<Kernel>>(faces, most_corners);
        else
            throw OptionError("the Laplacian is not symmetric");
    });
}

}  // namespace seamflow
