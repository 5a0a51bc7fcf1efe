#include "solvers/laplacian/laplacian_assembler.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "partition/executor.h"
#include "solvers/laplacian/kept_stiffness.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

/// Assembles M⁻¹ K from K and M.
class DividedByMass final : public LaplacianAssembler {
  public:
    DividedByMass(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices)
        : laplacian_(std::move(laplacian))
        , pairs_(laplacian_->pairs())
        , slots_(pairs_.size())
        , couplings_(pairs_.size())
        , diagonal_(n_vertices)
        , mass_(n_vertices)
    {
        std::iota(slots_.begin(), slots_.end(), 0);
        std::vector<bool> has_row(n_vertices, false);
        for (const auto& [v, w] : pairs_)
            has_row[v] = has_row[w] = true;
        rows_ = select(run_serially, n_vertices, [&](Index v) { return has_row[v]; });
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        entries.reserve(2 * pairs_.size() + rows_.size());
        for (const auto& [v, w] : pairs_)
            entries.insert(entries.end(), {{w, v}, {v, w}});
        for (const Index v : rows_)
            entries.push_back({v, v});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        std::fill(couplings_.begin(), couplings_.end(), 0.0);
        laplacian_->assemble(positions, factor, slots_, couplings_, diagonal_, mass_);
        const Index* slot = slots.data();
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            values[*slot++] += couplings_[i] / mass_[pairs_[i].first];
            values[*slot++] += couplings_[i] / mass_[pairs_[i].second];
        }
        for (const Index v : rows_)
            values[*slot++] += diagonal_[v] / mass_[v];
    }

    [[nodiscard]] double mass(Index v) const override { return mass_[v]; }

  private:
    std::unique_ptr<SymmetricLaplacian> laplacian_;
    std::vector<VertexPair> pairs_;
    /// Per pair: its own index, as the slot for assembling K; and factor · K there.
    std::vector<Index> slots_;
    std::vector<double> couplings_;
    /// Per vertex: factor · K_vv and M_v; and the vertices that have a row.
    std::vector<double> diagonal_;
    std::vector<double> mass_;
    std::vector<Index> rows_;
};

}  // namespace

std::unique_ptr<LaplacianAssembler> make_assembler(const ScaledLaplacian& laplacian, const FacesOnBothSides& faces,
                                                   const Points* stiffness_at)
{
    if (!is_symmetric(laplacian))
        return make_two_ring_assembler(faces);
    auto symmetric =
        make_symmetric_laplacian(laplacian, {faces.own, {}, faces.twin, faces.n_vertices, Contributions::OwnFaces});
    if (stiffness_at != nullptr)
        symmetric = keep_stiffness(std::move(symmetric), faces.n_vertices, *stiffness_at);
    return std::make_unique<DividedByMass>(std::move(symmetric), faces.n_vertices);
}

}  // namespace seamflow
