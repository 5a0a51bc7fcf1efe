#include "solvers/laplacian/laplacian_assembler.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// M⁻¹ K from edges.
template <EdgeKernel Kernel>
class EdgeAssembler final : public LaplacianAssembler {
  public:
    EdgeAssembler(Kernel kernel, const FaceView& faces)
        : kernel_(kernel)
        , degree_(faces.n_vertices, 0.0)
        , sum_(faces.n_vertices)
    {
        for (Index f = 0; f < faces.n_faces(); ++f) {
            const auto corners = faces.face(f);
            for (std::size_t k = 0; k < corners.size(); ++k)
                list_edge(faces, at(faces.offsets[f]) + k, corners[k], corners[(k + 1) % corners.size()]);
        }
        weights_.resize(edges_.size());
        if (!Kernel::averages_mass)
            std::fill(degree_.begin(), degree_.end(), 1.0);
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        entries.reserve(4 * edges_.size());
        for (const Edge& e : edges_)
            entries.insert(entries.end(), {{e.start, e.start}, {e.end, e.start}, {e.end, e.end}, {e.start, e.end}});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        measure_edges(positions);
        const Index* slot = slots.data();
        for (std::size_t i = 0; i < edges_.size(); ++i, slot += 4) {
            const Edge& e = edges_[i];
            const double weight = factor * e.share * weights_[i];
            const double at_start = weight * degree_[e.start] / sum_[e.start];
            const double at_end = weight * degree_[e.end] / sum_[e.end];
            values[slot[0]] += at_start;
            values[slot[1]] -= at_start;
            values[slot[2]] += at_end;
            values[slot[3]] -= at_end;
        }
    }

    void measure_mass(const Points& positions) override { measure_edges(positions); }

    [[nodiscard]] double mass(Index v) const override { return sum_[v] / degree_[v]; }

  private:
    /// An edge, once, whether it has one face or two.
    struct Edge {
        Index start;
        Index end;
        /// ½ for each of its half-edges.
        double share;
    };

    void list_edge(const FaceView& faces, std::size_t halfedge, Index start, Index end)
    {
        const Index twin = faces.twin[halfedge];
        if (twin >= 0 && at(twin) < halfedge)
            return;
        const double share = twin >= 0 ? 1.0 : 0.5;
        edges_.push_back({start, end, share});
        degree_[start] += share;
        degree_[end] += share;
    }

    void measure_edges(const Points& positions)
    {
        std::fill(sum_.begin(), sum_.end(), 0.0);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const Edge& e = edges_[i];
            const auto edge = kernel_.edge(positions.row(e.end) - positions.row(e.start));
            weights_[i] = edge.weight(1.0);
            sum_[e.start] += e.share * edge.mass();
            sum_[e.end] += e.share * edge.mass();
        }
    }

    Kernel kernel_;
    std::vector<Edge> edges_;
    /// Per vertex: number of edges, those on the boundary counted half, or 1 where M_v is a sum; and the sum.
    std::vector<double> degree_;
    std::vector<double> sum_;
    /// Per edge.
    std::vector<double> weights_;
};

/// M⁻¹ K from faces.
template <FaceKernel Kernel>
class FaceAssembler final : public LaplacianAssembler {
  public:
    explicit FaceAssembler(const FaceView& faces)
        : faces_(faces)
        , mass_(faces.n_vertices)
        , sizes_(faces.n_faces())
    {
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        for (Index f = 0; f < faces_.n_faces(); ++f)
            for (const Index row : faces_.face(f))
                for (const Index column : faces_.face(f))
                    entries.push_back({column, row});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        measure_mass(positions);
        const Index* slot = slots.data();
        for (Index f = 0; f < faces_.n_faces(); ++f) {
            const auto face = Kernel::whole_polygon(faces_.face(f), positions, sizes_[f], scratch_);
            for (std::size_t i = 0; i < face.size(); ++i) {
                const auto row = face.row(i, factor / (mass_[face.corner(i)] * face.divisor()));
                for (std::size_t k = 0; k < face.size(); ++k)
                    values[*slot++] += row(k);
            }
        }
    }

    void measure_mass(const Points& positions) override
    {
        std::fill(mass_.begin(), mass_.end(), 0.0);
        for (Index f = 0; f < faces_.n_faces(); ++f) {
            const auto corners = faces_.face(f);
            sizes_[f] = Kernel::size(corners, positions);
            for (const Index v : corners)
                mass_[v] += Kernel::corner_mass(sizes_[f], corners.size());
        }
    }

    [[nodiscard]] double mass(Index v) const override { return mass_[v]; }

  private:
    FaceView faces_;
    std::vector<double> mass_;
    /// Per face.
    std::vector<double> sizes_;
    typename Kernel::Scratch scratch_;
};

/// K of certain positions, M of any.
class KeptAssembler final : public LaplacianAssembler {
  public:
    KeptAssembler(std::unique_ptr<LaplacianAssembler> assembler, const Points& positions)
        : assembler_(std::move(assembler))
    {
        const std::vector<MatrixEntry> entries = assembler_->entries();
        std::vector<Index> slots(entries.size());
        std::iota(slots.begin(), slots.end(), 0);
        stiffness_.resize(entries.size(), 0.0);
        assembler_->add(positions, 1.0, slots, stiffness_);
        rows_.reserve(entries.size());
        for (std::size_t i = 0; i < entries.size(); ++i) {
            rows_.push_back(entries[i].row);
            stiffness_[i] *= assembler_->mass(entries[i].row);
        }
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override { return assembler_->entries(); }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        assembler_->measure_mass(positions);
        for (std::size_t i = 0; i < stiffness_.size(); ++i)
            values[slots[i]] += factor * stiffness_[i] / assembler_->mass(rows_[i]);
    }

    void measure_mass(const Points& positions) override { assembler_->measure_mass(positions); }
    [[nodiscard]] double mass(Index v) const override { return assembler_->mass(v); }

  private:
    std::unique_ptr<LaplacianAssembler> assembler_;
    /// Per entry.
    std::vector<Index> rows_;
    std::vector<double> stiffness_;
};

}  // namespace

std::unique_ptr<LaplacianAssembler> keep_stiffness(std::unique_ptr<LaplacianAssembler> assembler,
                                                   const Points& positions)
{
    return std::make_unique<KeptAssembler>(std::move(assembler), positions);
}

std::unique_ptr<LaplacianAssembler> make_assembler(const ScaledLaplacian& laplacian, const FaceView& faces)
{
    return with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) -> std::unique_ptr<LaplacianAssembler> {
        if constexpr (EdgeKernel<Kernel>)
            return std::make_unique<EdgeAssembler<Kernel>>(kernel, faces);
        else if constexpr (FaceKernel<Kernel>)
            return std::make_unique<FaceAssembler<Kernel>>(faces);
        else
            return make_two_ring_assembler(faces);
    });
}

}  // namespace seamflow
