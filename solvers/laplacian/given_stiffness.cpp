#include "solvers/laplacian/given_stiffness.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/kept_stiffness.h"

namespace seamflow {

namespace {

class GivenLaplacian final : public SymmetricLaplacian {
  public:
    GivenLaplacian(std::unique_ptr<SymmetricLaplacian> laplacian, const GivenStiffness& given,
                   std::span<const Index> local_to_global)
        : laplacian_(std::move(laplacian))
        , mass_(local_to_global.size(), 0.0)
    {
        const auto share_of_mass = [&](Index local) {
            const Index v = local_to_global[usize(local)];
            Index n = 0;
            for (Index i = given.neighbours.offsets[v]; i < given.neighbours.offsets[v + 1]; ++i)
                n += given.n_faces[i];
            return given.mass[v] / n;
        };
        std::vector<double> shares(mass_.size(), -1.0);
        for (const auto& [first, second] : laplacian_->pairs()) {
            const Index v = local_to_global[usize(first)];
            const Index i = given.neighbours.offsets[v] + place_in(given.neighbours[v], local_to_global[usize(second)]);
            entries_.push_back(-given.weights[i] / given.n_faces[i]);
            for (const Index local : {first, second}) {
                if (shares[local] < 0.0)
                    shares[local] = share_of_mass(local);
                mass_[local] += shares[local];
            }
        }
    }

    [[nodiscard]] bool uses_faces() const override { return laplacian_->uses_faces(); }
    [[nodiscard]] std::vector<VertexPair> pairs() const override { return laplacian_->pairs(); }

    void for_each_element(const std::function<void(std::size_t)>& action) const override
    {
        laplacian_->for_each_element(action);
    }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct*) override
    {
        measure_mass(positions, mass);
        std::ranges::fill(diagonal, 0.0);
        std::size_t i = 0;
        for (const auto& [v, w] : pairs()) {
            const double entry = factor * entries_[i];
            values[slots[i++]] += entry;
            diagonal[v] -= entry;
            diagonal[w] -= entry;
        }
    }

    void measure_mass(const Points&, std::span<double> mass) const override { std::ranges::copy(mass_, mass.begin()); }

  private:
    /// Which vertices have faces.
    std::unique_ptr<SymmetricLaplacian> laplacian_;
    /// Per pair, and per vertex: of the own faces.
    std::vector<double> entries_;
    std::vector<double> mass_;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> with_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian,
                                                   const GivenStiffness& given, std::span<const Index> local_to_global)
{
    const auto n = static_cast<Index>(local_to_global.size());
    // What is kept needs no positions.
    return keep_stiffness(std::make_unique<GivenLaplacian>(std::move(laplacian), given, local_to_global), n,
                          Points::Zero(n, 3), true);
}

}  // namespace seamflow
