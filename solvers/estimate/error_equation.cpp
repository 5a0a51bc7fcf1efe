#include "solvers/estimate/error_equation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "partition/index_lists.h"
#include "partition/labels.h"
#include "partition/metrics/vertex_normals.h"
#include "solvers/estimate/error_row.h"

namespace seamflow {

ErrorEquation::ErrorEquation(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                             const ScaledLaplacian& laplacian, InterfaceRanks& ranks, const Executor& exec)
    : decomposition_(&decomposition)
    , ranks_(&ranks)
    , laplacian_(laplacian)
    , tree_(ranks)
{
    std::vector<Index> kinds(topology.fixed.size());
    for_each(exec, static_cast<Index>(kinds.size()),
             [&](Index v) { kinds[v] = topology.moves(v) ? off_interface : fixed_vertex; });
    number_own(kinds);
    number_remote(mesh, topology, kinds);
    list_neighbours(kinds, exec);
    find_senses(mesh, topology);
    share_rows();
    rows_.couplings.resize(rows_.neighbours.values.size());
    for (auto* array : {&rows_.mass, &rows_.diagonal, &rows_.row_sum, &rows_.response})
        array->resize(numbering_.local_vertex.size());
    rows_.response.resize(rows_.response.size() + numbering_.remote.size());
    for (Points* array : {&rows_.normal, &iteration_.residual, &iteration_.error, &iteration_.product})
        array->setZero(size(), 3);
    iteration_.direction.setZero(std::ssize(rows_.response), 3);
    if (laplacian == Laplacian::PtackovaVelho)
        whole_.emplace(decomposition, mesh, topology, ranks);
}

/// Numbers the vertices of this rank's Γ.
/// @param kinds #V: receives the numbers.
void ErrorEquation::number_own(std::vector<Index>& kinds)
{
    for (Index s = 0; s < static_cast<Index>(decomposition_->sub_meshes.size()); ++s) {
        const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
        for (Index i = 0; i < sub_mesh.interface.size(); ++i)
            if (sub_mesh.interface.sharing[i].front() == s) {
                const Index v = sub_mesh.interface.vertices[i];
                kinds[sub_mesh.local_to_global[v]] = static_cast<Index>(numbering_.local_vertex.size());
                numbering_.index_in_sub_mesh.push_back(i);
                numbering_.local_vertex.push_back(v);
            }
        numbering_.first.push_back(static_cast<Index>(numbering_.local_vertex.size()));
    }
}

/// Numbers the vertices of Γ that other ranks own and that are neighbours of own vertices, in the order in which the
/// other ranks number them.
/// @param kinds #V: receives the numbers.
void ErrorEquation::number_remote(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& kinds)
{
    /// A vertex of Γ, and the lowest sub-mesh that has it, which numbers it.
    struct Neighbour {
        Index lowest;
        Index vertex;
        auto operator<=>(const Neighbour&) const = default;
    };
    if (ranks_->has_all())
        return;
    const auto& sub_meshes = decomposition_->sub_meshes;
    const std::vector<Index> labels = labels_by_face(*decomposition_, mesh.n_faces());
    std::vector<Neighbour> found;
    std::vector<Index> around;
    for (Index s = 0; s < static_cast<Index>(sub_meshes.size()); ++s)
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i)
            for (const Index neighbour : sub_meshes[s].corrected.neighbours[numbering_.index_in_sub_mesh[i]]) {
                const Index v = sub_meshes[s].local_to_global[neighbour];
                if (kinds[v] != off_interface)
                    continue;
                labels_around(topology, labels, v, around);
                if (around.size() > 1)
                    found.push_back({around.front(), v});
            }
    sort_unique(found);
    for (const Neighbour& neighbour : found) {
        kinds[neighbour.vertex] = static_cast<Index>(numbering_.local_vertex.size() + numbering_.remote.size());
        numbering_.remote.push_back(neighbour.lowest);
    }
}

/// Sets up the exchange of rows between ranks: a rank that numbers a neighbour of a vertex receives the vertex's row.
void ErrorEquation::share_rows()
{
    std::map<Index, SharedRows::Lists> with;
    const auto n = static_cast<Index>(numbering_.local_vertex.size());
    for (Index i = 0; i < static_cast<Index>(numbering_.remote.size()); ++i)
        with[ranks_->holder_of(numbering_.remote[i])].taken.push_back(n + i);
    for (Index i = 0; i < n; ++i)
        for (const Index other : rows_.neighbours[i])
            if (other >= n)
                with[ranks_->holder_of(numbering_.remote[other - n])].given.push_back(i);
    for (auto& [other, lists] : with)
        sort_unique(lists.given);
    shared_.emplace(*ranks_, std::move(with));
}

/// Fills rows_.neighbours.
/// @param kinds #V: the number of a vertex of Γ; off_interface or fixed_vertex for other vertices.
void ErrorEquation::list_neighbours(std::span<const Index> kinds, const Executor& exec)
{
    const auto& sub_meshes = decomposition_->sub_meshes;
    auto& [offsets, values] = rows_.neighbours;
    for (std::size_t s = 0; s < sub_meshes.size(); ++s)
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i)
            offsets.push_back(
                offsets.back() +
                static_cast<Index>(sub_meshes[s].corrected.neighbours[numbering_.index_in_sub_mesh[i]].size()));
    values.resize(offsets.back());
    for_each(exec, static_cast<Index>(sub_meshes.size()), [&](Index s) {
        const SubMesh& sub_mesh = sub_meshes[s];
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i) {
            Index entry = rows_.neighbours.offsets[i];
            for (const Index neighbour : sub_mesh.corrected.neighbours[numbering_.index_in_sub_mesh[i]])
                rows_.neighbours.values[entry++] = kinds[sub_mesh.local_to_global[neighbour]];
        }
    });
}

/// If faces are oriented differently, finds the orientation of the faces around each vertex.
void ErrorEquation::find_senses(const PolygonMesh& mesh, const Topology& topology)
{
    if (topology.oriented)
        return;
    const VertexNormals normals(mesh, topology);
    std::vector<std::int8_t>& senses = rows_.senses.values;
    std::vector<std::int8_t> of_others;
    for (std::size_t s = 0; s < decomposition_->sub_meshes.size(); ++s) {
        const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i) {
            of_others.clear();
            for (const Index corner : topology.corners_at(sub_mesh.local_to_global[numbering_.local_vertex[i]])) {
                const bool is_own = std::ranges::binary_search(sub_mesh.faces, topology.face_of[corner]);
                (is_own ? senses : of_others).push_back(normals.sense(corner));
            }
            senses.insert(senses.end(), of_others.begin(), of_others.end());
            rows_.senses.close();
        }
    }
}

void ErrorEquation::assemble(Index s, const Points& before, const Points& after, const Points& stiffness_at,
                             double time_step)
{
    const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
    for (Index i = first(s); i < first(s + 1); ++i) {
        const auto kinds = rows_.neighbours[i];
        const auto couplings = std::span(rows_.couplings).subspan(rows_.neighbours.offsets[i], kinds.size());
        const auto senses = rows_.senses.size() > 0 ? rows_.senses[i] : std::span<const std::int8_t>();
        const ErrorRow row = error_row(sub_mesh, laplacian_, numbering_.index_in_sub_mesh[i], senses, kinds,
                                       {before, after, stiffness_at, time_step}, couplings);
        rows_.mass[i] = row.mass;
        rows_.diagonal[i] = row.diagonal;
        rows_.row_sum[i] = row.diagonal - std::accumulate(couplings.begin(), couplings.end(), 0.0);
        const auto along = std::count_if(kinds.begin(), kinds.end(), [](Index kind) { return kind >= 0; });
        rows_.response[i] = along > 0 ? row.response / static_cast<double>(along) : 0.0;
        rows_.normal.row(i) = row.normal;
        iteration_.residual.row(i) = row.residual;
    }
}

void ErrorEquation::measure_whole_rows(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                                       const Points& after, double time_step, const Executor& exec)
{
    whole_->measure(mesh, topology, before, after, time_step, exec);
    for_each(exec, static_cast<Index>(decomposition_->sub_meshes.size()), [&](Index s) {
        for (Index i = first(s); i < first(s + 1); ++i)
            iteration_.residual.row(i) = whole_->residual(s, numbering_.index_in_sub_mesh[i]);
    });
}

/// Adds to the couplings between vertices of Γ. The mesh beyond Γ also couples these vertices to each other, so that
/// rough errors decay sooner: on regular grids T grows with the wave number along Γ, and not with its square. A
/// multiple of the response, the smaller the more the vertices are coupled already, approximates this: with these
/// numbers within a factor of 2 for Δ_F (Laplacian::Fujiwara) and Δ_A (Laplacian::AlexaWardetzky) on regular quads and
/// triangles at all wave numbers except the highest.
void ErrorEquation::stiffen(const Executor& exec)
{
    for_each(exec, size(), [&](Index i) {
        for (Index e = rows_.neighbours.offsets[i]; e < rows_.neighbours.offsets[i + 1]; ++e)
            if (const Index other = rows_.neighbours.values[e]; other >= 0) {
                const double response = std::min(rows_.response[i], rows_.response[other]);
                const double tie = 1.25 * response - 0.5 * std::min(response, rows_.couplings[e]);
                rows_.couplings[e] += tie;
                rows_.diagonal[i] += tie;
            }
    });
}

/// The sum of value(i) over the vertices of all ranks, always in the same order.
template <class Value>
double ErrorEquation::add_up(const Executor& exec, Value&& value)
{
    sums_.assign(usize(ranks_->n_sub_meshes()), 0.0);
    for_each(exec, static_cast<Index>(ranks_->global_numbers().size()), [&](Index s) {
        double total = 0.0;
        for (Index i = first(s); i < first(s + 1); ++i)
            total += value(i);
        if (ranks_->is_own(s))
            sums_[ranks_->global_numbers()[s]] = total;
    });
    return tree_.add_up(sums_, 1).front();
}

/// Row i of T times the direction.
Point ErrorEquation::product(Index i) const
{
    Point sum = rows_.diagonal[i] * iteration_.direction.row(i);
    for (Index e = rows_.neighbours.offsets[i]; e < rows_.neighbours.offsets[i + 1]; ++e)
        if (rows_.neighbours.values[e] >= 0)
            sum -= rows_.couplings[e] * iteration_.direction.row(rows_.neighbours.values[e]);
    return sum;
}

/// Conjugate gradients on x, y and z as one system, preconditioned by the diagonal.
void ErrorEquation::solve(const Executor& exec)
{
    constexpr int most_iterations = 30;
    constexpr double squared_tolerance = 1e-4;
    shared_->exchange(rows_.response.data(), 1);
    stiffen(exec);
    // p = z = D⁻¹ r, e = 0
    double size_before = add_up(exec, [&](Index i) {
        iteration_.direction.row(i) = iteration_.residual.row(i) / rows_.diagonal[i];
        iteration_.error.row(i).setZero();
        return iteration_.residual.row(i).dot(iteration_.direction.row(i));
    });
    if (!std::isfinite(size_before))
        iteration_.error.setConstant(size_before);
    const double enough = squared_tolerance * size_before;
    for (int iteration = 0; iteration < most_iterations && size_before > enough; ++iteration) {
        shared_->exchange(iteration_.direction.data(), 3);
        // q = T p
        const double curvature = add_up(exec, [&](Index i) {
            iteration_.product.row(i) = product(i);
            return iteration_.product.row(i).dot(iteration_.direction.row(i));
        });
        // α = (r, z) / (p, q), e = e + α p, r = r - α q
        const double length = size_before / curvature;
        const double size_now = add_up(exec, [&](Index i) {
            iteration_.error.row(i) += length * iteration_.direction.row(i);
            iteration_.residual.row(i) -= length * iteration_.product.row(i);
            return iteration_.residual.row(i).squaredNorm() / rows_.diagonal[i];
        });
        // β = (r, z) / (r, z) before, p = z + β p
        const double share = size_now / size_before;
        for_each(exec, size(), [&](Index i) {
            iteration_.direction.row(i) =
                iteration_.residual.row(i) / rows_.diagonal[i] + share * iteration_.direction.row(i);
        });
        size_before = size_now;
    }
}

}  // namespace seamflow
