#include "solvers/estimate/indicator_equation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/estimate/residual_indicator.h"

namespace seamflow {

namespace {

/// How many vertices of Γ are taken together, whatever the loop.
constexpr Index block = 1024;

Index n_blocks(Index n)
{
    return n / block + (n % block > 0 ? 1 : 0);
}

/// Runs body(number, begin, end) for each block.
template <class Body>
void for_each_part(const Loop& loop, Index n, Body&& body)
{
    for_each(loop, n_blocks(n), [&](Index number) { body(number, number * block, std::min(n, (number + 1) * block)); });
}

/// Runs body(i).
template <class Body>
void for_each_in_blocks(const Loop& loop, Index n, Body&& body)
{
    for_each_part(loop, n, [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            body(i);
    });
}

}  // namespace

IndicatorEquation::IndicatorEquation(const Decomposition& decomposition, const PolygonMesh& mesh,
                                     const Topology& topology, Laplacian laplacian, const Loop& loop)
    : decomposition_(&decomposition)
    , laplacian_(laplacian)
{
    std::vector<Index> kinds(topology.fixed.size());
    for_each(loop, static_cast<Index>(kinds.size()),
             [&](Index v) { kinds[v] = topology.moves(v) ? off_interface : held_fixed; });
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const auto& vertices = sub_mesh.interface.vertices;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (sub_mesh.owned[vertices[i]] != 0) {
                kinds[sub_mesh.local_to_global[vertices[i]]] = static_cast<Index>(local_vertex_.size());
                index_in_owner_.push_back(static_cast<Index>(i));
                local_vertex_.push_back(vertices[i]);
            }
        first_.push_back(static_cast<Index>(local_vertex_.size()));
    }
    list_neighbours(kinds, loop);
    couplings_.resize(neighbours_.values.size());
    for (auto* array : {&mass_, &diagonal_, &row_sum_, &yielded_})
        array->resize(local_vertex_.size());
    for (Points* array : {&normal_, &residual_, &error_, &direction_, &product_})
        array->setZero(size(), 3);
    of_block_.resize(n_blocks(size()));
    if (laplacian == Laplacian::PtackovaVelho)
        make_whole_rows(mesh, topology, kinds);
}

/// @param kinds #V: the number of a vertex of Γ, or see off_interface.
void IndicatorEquation::list_neighbours(std::span<const Index> kinds, const Loop& loop)
{
    const auto& sub_meshes = decomposition_->sub_meshes;
    auto& [offsets, values] = neighbours_;
    for (std::size_t s = 0; s < sub_meshes.size(); ++s)
        for (Index i = first_[s]; i < first_[s + 1]; ++i)
            offsets.push_back(offsets.back() +
                              static_cast<Index>(sub_meshes[s].seam.neighbours[index_in_owner_[i]].size()));
    values.resize(offsets.back());
    for_each(loop, static_cast<Index>(sub_meshes.size()), [&](Index s) {
        const SubMesh& sub_mesh = sub_meshes[s];
        for (Index i = first_[s]; i < first_[s + 1]; ++i) {
            Index place = neighbours_.offsets[i];
            for (const Index neighbour : sub_mesh.seam.neighbours[index_in_owner_[i]])
                neighbours_.values[place++] = kinds[sub_mesh.local_to_global[neighbour]];
        }
    });
}

void IndicatorEquation::make_whole_rows(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> kinds)
{
    std::vector<Index> number(kinds.size(), -1);
    std::vector<Index> vertices(local_vertex_.size());
    for (std::size_t v = 0; v < kinds.size(); ++v)
        if (kinds[v] >= 0)
            vertices[kinds[v]] = static_cast<Index>(v);
    std::vector<Index> around;
    for (Index i = 0; i < size(); ++i) {
        around.clear();
        for (const Index corner : topology.corners_at(vertices[i]))
            for (const Index w : mesh.face(topology.face_of[corner]))
                if (kinds[w] == off_interface)
                    around.push_back(w);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const Index w : around) {
            if (number[w] < 0) {
                number[w] = static_cast<Index>(n_shared_.size());
                vertices.push_back(w);
                n_shared_.push_back(0);
            }
            ++n_shared_[number[w]];
            around_.values.push_back(number[w]);
        }
        around_.close();
    }
    whole_rows_.emplace(mesh, topology, vertices);
    whole_residual_.resize(static_cast<Eigen::Index>(vertices.size()), 3);
}

void IndicatorEquation::assemble(Index s, const Points& before, const Points& after, double time_step)
{
    const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
    for (Index i = first(s); i < first(s + 1); ++i) {
        const auto kinds = neighbours_[i];
        const auto couplings = std::span(couplings_).subspan(neighbours_.offsets[i], kinds.size());
        const IndicatorRow row =
            indicator_row(sub_mesh, laplacian_, index_in_owner_[i], kinds, before, after, time_step, couplings);
        mass_[i] = row.mass;
        diagonal_[i] = row.diagonal;
        row_sum_[i] = row.diagonal - std::accumulate(couplings.begin(), couplings.end(), 0.0);
        const auto along = std::count_if(kinds.begin(), kinds.end(), [](Index kind) { return kind >= 0; });
        yielded_[i] = along > 0 ? row.yielded / static_cast<double>(along) : 0.0;
        normal_.row(i) = row.normal;
        residual_.row(i) = row.residual;
    }
}

void IndicatorEquation::measure_whole_rows(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                                           const Points& after, double time_step, const Loop& loop)
{
    whole_rows_->evaluate(mesh, topology, before, after, time_step, loop, whole_residual_);
    for_each_in_blocks(loop, size(), [&](Index i) {
        residual_.row(i) = whole_residual_.row(i);
        for (const Index w : around_[i])
            residual_.row(i) += whole_residual_.row(size() + w) / n_shared_[w];
    });
}

/// What is beyond Γ also ties the vertices of Γ to each other, so that rough errors die away sooner: on regular grids T
/// grows with the wave number along Γ, and not with its square. A multiple of what is yielded to each other, the
/// smaller the more the vertices are coupled already, comes near to that: with these numbers within a factor of 2 for
/// Δ_F and Δ_A on regular quads and triangles at all wave numbers but the highest.
void IndicatorEquation::stiffen(const Loop& loop)
{
    for_each_in_blocks(loop, size(), [&](Index i) {
        for (Index e = neighbours_.offsets[i]; e < neighbours_.offsets[i + 1]; ++e)
            if (const Index other = neighbours_.values[e]; other >= 0) {
                const double yielded = std::min(yielded_[i], yielded_[other]);
                const double tie = 1.25 * yielded - 0.5 * std::min(yielded, couplings_[e]);
                couplings_[e] += tie;
                diagonal_[i] += tie;
            }
    });
}

/// The sum of value(i), always in the same order.
template <class Value>
double IndicatorEquation::add_up(const Loop& loop, Value&& value)
{
    for_each_part(loop, size(), [&](Index number, Index begin, Index end) {
        double total = 0.0;
        for (Index i = begin; i < end; ++i)
            total += value(i);
        of_block_[number] = total;
    });
    double total = 0.0;
    for (const double part : of_block_)
        total += part;
    return total;
}

/// T times the direction.
Point IndicatorEquation::product(Index i) const
{
    Point sum = diagonal_[i] * direction_.row(i);
    for (Index e = neighbours_.offsets[i]; e < neighbours_.offsets[i + 1]; ++e)
        if (neighbours_.values[e] >= 0)
            sum -= couplings_[e] * direction_.row(neighbours_.values[e]);
    return sum;
}

/// Conjugate gradients on x, y and z as one system, preconditioned by the diagonal.
void IndicatorEquation::solve(const Loop& loop)
{
    constexpr int most_iterations = 30;
    constexpr double squared_tolerance = 1e-4;
    stiffen(loop);
    double size_before = add_up(loop, [&](Index i) {
        direction_.row(i) = residual_.row(i) / diagonal_[i];
        error_.row(i).setZero();
        return residual_.row(i).dot(direction_.row(i));
    });
    if (!std::isfinite(size_before))
        error_.setConstant(size_before);
    const double enough = squared_tolerance * size_before;
    for (int iteration = 0; iteration < most_iterations && size_before > enough; ++iteration) {
        const double curvature = add_up(loop, [&](Index i) {
            product_.row(i) = product(i);
            return product_.row(i).dot(direction_.row(i));
        });
        const double length = size_before / curvature;
        const double size_now = add_up(loop, [&](Index i) {
            error_.row(i) += length * direction_.row(i);
            residual_.row(i) -= length * product_.row(i);
            return residual_.row(i).squaredNorm() / diagonal_[i];
        });
        const double share = size_now / size_before;
        for_each_in_blocks(loop, size(), [&](Index i) {
            direction_.row(i) = residual_.row(i) / diagonal_[i] + share * direction_.row(i);
        });
        size_before = size_now;
    }
}

}  // namespace seamflow
