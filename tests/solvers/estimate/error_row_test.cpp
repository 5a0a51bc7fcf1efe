#include <algorithm>
#include <map>

#include <doctest/doctest.h>

#include "solvers/estimate/error_row.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/matrices.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

constexpr double error_time_step = 0.03;

/// Every neighbour as what it is, numbered by its index in the whole mesh.
std::vector<Index> kinds_at(const test::CutMesh& cut, const SubMesh& sub_mesh, Index i)
{
    std::vector<Index> kinds;
    for (const Index local : sub_mesh.corrected.neighbours[i]) {
        const Index v = sub_mesh.local_to_global[local];
        const auto corners = cut.topology.corners_at(v);
        const auto label = [&](Index corner) { return cut.labels[cut.topology.face_of[corner]]; };
        const bool shared =
            std::any_of(corners.begin(), corners.end(), [&](Index c) { return label(c) != label(corners.front()); });
        if (cut.topology.kind[v] != VertexKind::Interior)
            kinds.push_back(fixed_vertex);
        else
            kinds.push_back(shared ? v : off_interface);
    }
    return kinds;
}

/// Calls action(sub_mesh, i, row, kinds, couplings) for every vertex of every Γ.
template <class Action>
void for_each_row(const test::CutMesh& cut, Laplacian laplacian, const Points& after, Action&& action)
{
    const Decomposition decomposition = test::decompose(cut);
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const Points before_here = test::localised(sub_mesh, cut.mesh.vertices);
        const Points after_here = test::localised(sub_mesh, after);
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            const auto kinds = kinds_at(cut, sub_mesh, i);
            std::vector<double> couplings(kinds.size());
            const ErrorRow row = error_row(sub_mesh, laplacian, i, {}, kinds,
                                           {before_here, after_here, before_here, error_time_step}, couplings);
            action(sub_mesh, i, row, kinds, couplings);
        }
    }
}

}  // namespace

TEST_CASE("the residual is that of the whole system in its symmetric form")
{
    for (const test::CutMesh& cut : test::cut_meshes())
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
            CAPTURE(cut.name);
            CAPTURE(name_of(laplacian));
            const Points& before = cut.mesh.vertices;
            const Points after = before + 0.05 * Points::Random(before.rows(), 3);
            const Points expected =
                after - before + error_time_step * test::dense_laplacian(laplacian, cut.mesh, cut.topology) * after;
            for_each_row(cut, laplacian, after,
                         [&](const SubMesh& sub_mesh, Index i, const ErrorRow& row, const auto&, const auto&) {
                             const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                             CHECK(row.mass > 0.0);
                             CHECK((row.residual / row.mass - expected.row(v)).norm() <=
                                   1e-9 * (1.0 + expected.row(v).norm()));
                         });
        }
}

TEST_CASE("T is symmetric and positive definite, the same for all sub-meshes at a vertex")
{
    for (const test::CutMesh& cut : test::cut_meshes())
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho}) {
            CAPTURE(cut.name);
            std::map<std::pair<Index, Index>, double> entries;
            for_each_row(cut, laplacian, cut.mesh.vertices,
                         [&](const SubMesh& sub_mesh, Index i, const ErrorRow& row, const auto& kinds,
                             const std::vector<double>& couplings) {
                             const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                             double sum = 0.0;
                             for (std::size_t j = 0; j < kinds.size(); ++j) {
                                 sum += couplings[j];
                                 CHECK(couplings[j] >= 0.0);
                                 if (kinds[j] < 0) {
                                     CHECK(couplings[j] == 0.0);
                                     continue;
                                 }
                                 for (const auto& key : {std::pair{v, kinds[j]}, std::pair{kinds[j], v}}) {
                                     const auto [entry, is_new] = entries.try_emplace(key, couplings[j]);
                                     CHECK(std::abs(couplings[j] - entry->second) <= 1e-9 * row.diagonal);
                                 }
                             }
                             CHECK(row.diagonal >= sum + 0.999 * row.mass);
                             CHECK(row.response >= 0.0);
                             CHECK((row.normal.norm() == test::relative(1.0, 1e-5) || row.normal.norm() == 0.0));
                         });
        }
}
