#include "solvers/interface/coarse_space.h"

#include <algorithm>

#include "solvers/cholmod_solver.h"
#include "solvers/factor_memory.h"

namespace seamflow {

namespace {

/// How much is added to the diagonal of E, relative to it. Plateaus can cancel each other (those of two sub-meshes do,
/// and the black and white ones of a chessboard), and then E is singular; as Z E⁻¹ does not depend on their share, it
/// does no harm that it is arbitrary.
constexpr double regularisation = 1e-8;

/// The neighbours' columns, with zeros after them.
std::size_t whole_columns(std::size_t n_neighbours)
{
    return (n_neighbours + 2) / 3 * 3;
}

}  // namespace

CoarseSpace::CoarseSpace(const InterfaceCopies& copies)
    : copies_(copies)
    , products_(at(copies.n_sub_meshes()))
    , energies_(at(copies.n_sub_meshes()))
{
    find_neighbours();
    number_unknowns();
    shares_.resize(static_cast<Eigen::Index>(neighbours_.values.size()), 3);
    heights_.resize(n_unknowns_, 3);
}

CoarseSpace::~CoarseSpace()
{
    free_factor();
}

void CoarseSpace::find_neighbours()
{
    std::vector<Index> found;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s) {
        found.clear();
        for (Index copy = copies_.first[at(s)]; copy < copies_.first[at(s) + 1]; ++copy)
            for (const Index other : copies_.of_vertex[copies_.vertex[at(copy)]])
                found.push_back(copies_.sub_mesh[at(other)]);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        neighbours_.values.insert(neighbours_.values.end(), found.begin(), found.end());
        neighbours_.close();
    }
}

/// Two unknowns have an entry in E where their plateaus meet one sub-mesh.
void CoarseSpace::number_unknowns()
{
    unknown_of_.assign(at(copies_.n_sub_meshes()), -1);
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s)
        if (copies_.n_in(s) > 0)
            unknown_of_[at(s)] = n_unknowns_++;
    if (n_unknowns_ == 0)
        return;
    const auto pattern = [this] {
        std::vector<MatrixEntry> entries;
        for (Index s = 0; s < neighbours_.size(); ++s)
            for (const Index t : neighbours_[s])
                for (const Index u : neighbours_[s])
                    if (unknown_of_[at(t)] <= unknown_of_[at(u)])
                        entries.push_back({unknown_of_[at(u)], unknown_of_[at(t)]});
        return make_pattern(n_unknowns_, entries);
    };
    CholmodWorkspace workspace;
    const std::vector<Index> order = elimination_order(pattern(), workspace);
    std::vector<Index> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place[at(order[i])] = static_cast<Index>(i);
    for (Index& unknown : unknown_of_)
        if (unknown >= 0)
            unknown = place[at(unknown)];
    upper_ = pattern();
    solver_.emplace(upper_);
}

void CoarseSpace::prepare(std::span<const NeumannSystem* const> systems, std::span<const double> weights,
                          const Loop& loop)
{
    free_factor();
    if (n_unknowns_ == 0)
        return;
    for_each(loop, copies_.n_sub_meshes(),
             [&](Index s) { multiply_plateaus(s, systems[at(s)]->schur(), weights); });
    assemble();
    factorised_ = solver_->factorise(values_, heap_memory(), workspace_);
}

/// With S = R Rᵀ, the share of E is (Rᵀ Z)ᵀ (Rᵀ Z), which rounding cannot make indefinite.
void CoarseSpace::multiply_plateaus(Index s, const DenseFactor& schur, std::span<const double> weights)
{
    const auto neighbours = neighbours_[s];
    const std::size_t n = at(copies_.n_in(s));
    std::vector<float>& columns = products_[at(s)];
    columns.assign(n * whole_columns(neighbours.size()), 0.0F);
    for (std::size_t i = 0; i < n; ++i)
        for (const Index copy : copies_.of_vertex[copies_.vertex[at(copies_.first[at(s)]) + i]]) {
            const auto t = std::lower_bound(neighbours.begin(), neighbours.end(), copies_.sub_mesh[at(copy)]);
            columns[static_cast<std::size_t>(t - neighbours.begin()) * n + i] = static_cast<float>(weights[at(copy)]);
        }
    const auto on_each_three = [&](auto&& apply) {
        for (std::size_t c = 0; c < neighbours.size(); c += 3)
            apply(FloatColumns{&columns[c * n], &columns[(c + 1) * n], &columns[(c + 2) * n]});
    };
    on_each_three([&](FloatColumns v) { schur.multiply_by_root_transposed(v); });
    const Eigen::Map<const Eigen::MatrixXf> roots(columns.data(), static_cast<Eigen::Index>(n),
                                                  static_cast<Eigen::Index>(neighbours.size()));
    energies_[at(s)].noalias() = roots.cast<double>().transpose() * roots.cast<double>();
    on_each_three([&](FloatColumns v) { schur.multiply_by_root(v); });
}

void CoarseSpace::assemble()
{
    values_.assign(at(upper_.n_entries()), 0.0);
    for (Index s = 0; s < neighbours_.size(); ++s) {
        const auto neighbours = neighbours_[s];
        for (std::size_t t = 0; t < neighbours.size(); ++t)
            for (std::size_t u = 0; u < neighbours.size(); ++u) {
                const Index row = unknown_of_[at(neighbours[t])];
                const Index column = unknown_of_[at(neighbours[u])];
                if (row <= column)
                    values_[at(upper_.slot({column, row}))] +=
                        energies_[at(s)](static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(u));
            }
    }
    for (Index u = 0; u < n_unknowns_; ++u)
        values_[at(upper_.slot({u, u}))] *= 1.0 + regularisation;
}

void CoarseSpace::correct(const Points& residual, std::span<const double> weights, Points& y, const Loop& loop)
{
    if (!factorised_)
        return;
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) {
        const Index n = copies_.n_in(s);
        const Index first = copies_.first[at(s)];
        const std::size_t n_neighbours = neighbours_[s].size();
        for (std::size_t t = 0; t < n_neighbours; ++t) {
            const float* product = products_[at(s)].data() + t * at(n);
            Point sum = Point::Zero();
            for (Index i = 0; i < n; ++i)
                sum += static_cast<double>(product[i]) * y.row(copies_.vertex[at(first + i)]);
            shares_.row(neighbours_.offsets[at(s)] + static_cast<Eigen::Index>(t)) = sum;
        }
    });
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) {
        if (unknown_of_[at(s)] < 0)
            return;
        Point sum = Point::Zero();
        for (Index copy = copies_.first[at(s)]; copy < copies_.first[at(s) + 1]; ++copy)
            sum += weights[at(copy)] * residual.row(copies_.vertex[at(copy)]);
        for (const Index t : neighbours_[s]) {
            const auto around = neighbours_[t];
            const auto place = std::lower_bound(around.begin(), around.end(), s) - around.begin();
            sum -= shares_.row(neighbours_.offsets[at(t)] + place);
        }
        heights_.row(unknown_of_[at(s)]) = sum;
    });
    solver_->solve(heights_, heights_, workspace_);
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        for (const Index copy : copies_.of_vertex[v])
            y.row(v) += weights[at(copy)] * heights_.row(unknown_of_[at(copies_.sub_mesh[at(copy)])]);
    });
}

void CoarseSpace::free_factor()
{
    if (factorised_)
        solver_->free_factor(heap_memory());
    factorised_ = false;
}

}  // namespace seamflow
