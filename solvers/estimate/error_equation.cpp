#include "solvers/estimate/error_equation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "partition/index_lists.h"
#include "solvers/estimate/error_row.h"

namespace seamflow {

namespace {

/// How many vertices of Γ are taken together, whatever the loop.
constexpr Index vertices_per_block = 1024;

Index n_blocks(Index n)
{
    return n / vertices_per_block + (n % vertices_per_block > 0 ? 1 : 0);
}

/// Runs body(number, begin, end) for each block.
template <class Body>
void for_each_part(const Loop& loop, Index n, Body&& body)
{
    for_each(loop, n_blocks(n), [&](Index number) {
        body(number, number * vertices_per_block, std::min(n, (number + 1) * vertices_per_block));
    });
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

ErrorEquation::ErrorEquation(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                             Laplacian laplacian, const Loop& loop)
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
                kinds[sub_mesh.local_to_global[vertices[i]]] = static_cast<Index>(numbering_.local_vertex.size());
                numbering_.index_in_owner.push_back(static_cast<Index>(i));
                numbering_.local_vertex.push_back(vertices[i]);
            }
        numbering_.first.push_back(static_cast<Index>(numbering_.local_vertex.size()));
    }
    list_neighbours(kinds, loop);
    rows_.couplings.resize(rows_.neighbours.values.size());
    for (auto* array : {&rows_.mass, &rows_.diagonal, &rows_.row_sum, &rows_.response})
        array->resize(numbering_.local_vertex.size());
    for (Points* array :
         {&rows_.normal, &iteration_.residual, &iteration_.error, &iteration_.direction, &iteration_.product})
        array->setZero(size(), 3);
    iteration_.of_block.resize(n_blocks(size()));
    if (laplacian == Laplacian::PtackovaVelho)
        make_whole_rows(mesh, topology, kinds);
}

/// @param kinds #V: the number of a vertex of Γ, or see off_interface.
void ErrorEquation::list_neighbours(std::span<const Index> kinds, const Loop& loop)
{
    const auto& sub_meshes = decomposition_->sub_meshes;
    auto& [offsets, values] = rows_.neighbours;
    for (std::size_t s = 0; s < sub_meshes.size(); ++s)
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i)
            offsets.push_back(offsets.back() +
                              static_cast<Index>(sub_meshes[s].seam.neighbours[numbering_.index_in_owner[i]].size()));
    values.resize(offsets.back());
    for_each(loop, static_cast<Index>(sub_meshes.size()), [&](Index s) {
        const SubMesh& sub_mesh = sub_meshes[s];
        for (Index i = numbering_.first[s]; i < numbering_.first[s + 1]; ++i) {
            Index place = rows_.neighbours.offsets[i];
            for (const Index neighbour : sub_mesh.seam.neighbours[numbering_.index_in_owner[i]])
                rows_.neighbours.values[place++] = kinds[sub_mesh.local_to_global[neighbour]];
        }
    });
}

void ErrorEquation::make_whole_rows(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> kinds)
{
    std::vector<Index> number(kinds.size(), -1);
    std::vector<Index> vertices(numbering_.local_vertex.size());
    for (std::size_t v = 0; v < kinds.size(); ++v)
        if (kinds[v] >= 0)
            vertices[kinds[v]] = static_cast<Index>(v);
    std::vector<Index> n_shared;
    IndexLists around_lists;
    std::vector<Index> around;
    for (Index i = 0; i < size(); ++i) {
        around.clear();
        for (const Index corner : topology.corners_at(vertices[i]))
            for (const Index w : mesh.face(topology.face_of[corner]))
                if (kinds[w] == off_interface)
                    around.push_back(w);
        sort_unique(around);
        for (const Index w : around) {
            if (number[w] < 0) {
                number[w] = static_cast<Index>(n_shared.size());
                vertices.push_back(w);
                n_shared.push_back(0);
            }
            ++n_shared[number[w]];
            around_lists.values.push_back(number[w]);
        }
        around_lists.close();
    }
    whole_.emplace(WholeRows{PtackovaRows(mesh, topology, vertices), Points(vertices.size(), 3), std::move(n_shared),
                             std::move(around_lists)});
}

void ErrorEquation::assemble(Index s, const Points& before, const Points& after, const Points& stiffness_at,
                             double time_step)
{
    const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
    for (Index i = first(s); i < first(s + 1); ++i) {
        const auto kinds = rows_.neighbours[i];
        const auto couplings = std::span(rows_.couplings).subspan(rows_.neighbours.offsets[i], kinds.size());
        const ErrorRow row = error_row(sub_mesh, laplacian_, numbering_.index_in_owner[i], kinds, before, after,
                                       stiffness_at, time_step, couplings);
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
                                       const Points& after, double time_step, const Loop& loop)
{
    whole_->rows.evaluate(mesh, topology, before, after, time_step, loop, whole_->residual);
    for_each_in_blocks(loop, size(), [&](Index i) {
        iteration_.residual.row(i) = whole_->residual.row(i);
        for (const Index w : whole_->around[i])
            iteration_.residual.row(i) += whole_->residual.row(size() + w) / whole_->n_shared[w];
    });
}

/// What is beyond Γ also ties the vertices of Γ to each other, so that rough errors die away sooner: on regular grids T
/// grows with the wave number along Γ, and not with its square. A multiple of the response, the
/// smaller the more the vertices are coupled already, comes near to that: with these numbers within a factor of 2 for
/// Δ_F and Δ_A on regular quads and triangles at all wave numbers but the highest.
void ErrorEquation::stiffen(const Loop& loop)
{
    for_each_in_blocks(loop, size(), [&](Index i) {
        for (Index e = rows_.neighbours.offsets[i]; e < rows_.neighbours.offsets[i + 1]; ++e)
            if (const Index other = rows_.neighbours.values[e]; other >= 0) {
                const double response = std::min(rows_.response[i], rows_.response[other]);
                const double tie = 1.25 * response - 0.5 * std::min(response, rows_.couplings[e]);
                rows_.couplings[e] += tie;
                rows_.diagonal[i] += tie;
            }
    });
}

/// The sum of value(i), always in the same order.
template <class Value>
double ErrorEquation::add_up(const Loop& loop, Value&& value)
{
    for_each_part(loop, size(), [&](Index number, Index begin, Index end) {
        double total = 0.0;
        for (Index i = begin; i < end; ++i)
            total += value(i);
        iteration_.of_block[number] = total;
    });
    double total = 0.0;
    for (const double part : iteration_.of_block)
        total += part;
    return total;
}

/// T times the direction.
Point ErrorEquation::product(Index i) const
{
    Point sum = rows_.diagonal[i] * iteration_.direction.row(i);
    for (Index e = rows_.neighbours.offsets[i]; e < rows_.neighbours.offsets[i + 1]; ++e)
        if (rows_.neighbours.values[e] >= 0)
            sum -= rows_.couplings[e] * iteration_.direction.row(rows_.neighbours.values[e]);
    return sum;
}

/// Conjugate gradients on x, y and z as one system, preconditioned by the diagonal.
void ErrorEquation::solve(const Loop& loop)
{
    constexpr int most_iterations = 30;
    constexpr double squared_tolerance = 1e-4;
    stiffen(loop);
    double size_before = add_up(loop, [&](Index i) {
        iteration_.direction.row(i) = iteration_.residual.row(i) / rows_.diagonal[i];
        iteration_.error.row(i).setZero();
        return iteration_.residual.row(i).dot(iteration_.direction.row(i));
    });
    if (!std::isfinite(size_before))
        iteration_.error.setConstant(size_before);
    const double enough = squared_tolerance * size_before;
    for (int iteration = 0; iteration < most_iterations && size_before > enough; ++iteration) {
        const double curvature = add_up(loop, [&](Index i) {
            iteration_.product.row(i) = product(i);
            return iteration_.product.row(i).dot(iteration_.direction.row(i));
        });
        const double length = size_before / curvature;
        const double size_now = add_up(loop, [&](Index i) {
            iteration_.error.row(i) += length * iteration_.direction.row(i);
            iteration_.residual.row(i) -= length * iteration_.product.row(i);
            return iteration_.residual.row(i).squaredNorm() / rows_.diagonal[i];
        });
        const double share = size_now / size_before;
        for_each_in_blocks(loop, size(), [&](Index i) {
            iteration_.direction.row(i) =
                iteration_.residual.row(i) / rows_.diagonal[i] + share * iteration_.direction.row(i);
        });
        size_before = size_now;
    }
}

}  // namespace seamflow
