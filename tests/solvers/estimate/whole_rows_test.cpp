#include <map>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "solvers/estimate/whole_rows.h"
#include "tests/support/allocations.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/matrices.h"

using namespace seamflow;

namespace {

double vertex_area(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    double sum = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const auto corners = mesh.face(topology.face_of[corner]);
        sum += area(corners, mesh.vertices) / static_cast<double>(corners.size());
    }
    return sum;
}

/// Per copy, sub-mesh and local vertex: the moving vertices off Γ with which it shares a face of the sub-mesh.
std::map<std::pair<Index, Index>, std::set<Index>> beside_interface(const Decomposition& decomposition)
{
    std::map<std::pair<Index, Index>, std::set<Index>> beside;
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
        const SubMesh& sub_mesh = decomposition.sub_meshes[s];
        const auto& on_interface = sub_mesh.interface.vertices;
        for (Index i = 0; i < sub_mesh.interface.size(); ++i)
            for (const Index f : sub_mesh.interface.own_faces[i])
                for (const Index v : sub_mesh.face_vertices[f])
                    if (sub_mesh.fixed[v] == 0 && std::ranges::find(on_interface, v) == on_interface.end())
                        beside[{s, on_interface[i]}].insert(sub_mesh.local_to_global[v]);
    }
    return beside;
}

}  // namespace

TEST_CASE("vertices of Γ have the rows of the whole system there and their parts of those beside, without allocations")
{
    constexpr double time_step = 0.03;
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const PolygonMesh& mesh = cut.mesh;
        const Points after = mesh.vertices + 0.05 * Points::Random(mesh.n_vertices(), 3);
        const Eigen::MatrixXd laplacian = test::dense_laplacian(Laplacian::PtackovaVelho, mesh, cut.topology);
        Points expected = after - mesh.vertices + time_step * laplacian * after;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            expected.row(v) *= vertex_area(mesh, cut.topology, v);
        const Decomposition decomposition = test::decompose(cut);
        const auto beside = beside_interface(decomposition);
        std::map<Index, double> n_sharing;
        for (const auto& [copy, vertices] : beside)
            for (const Index v : vertices)
                n_sharing[v] += 1.0;

        OneRank ranks(static_cast<Index>(decomposition.sub_meshes.size()));
        WholeRows rows(decomposition, mesh, cut.topology, ranks);
        const Executor exec = run_serially;
        const long allocations = test::n_allocations();
        rows.measure(mesh, cut.topology, mesh.vertices, after, time_step, exec);
        CHECK(test::n_allocations() == allocations);
        for (Index s = 0; s < ranks.n_sub_meshes(); ++s) {
            const SubMeshInterface& interface = decomposition.sub_meshes[s].interface;
            for (Index i = 0; i < interface.size(); ++i) {
                Point row = expected.row(decomposition.sub_meshes[s].local_to_global[interface.vertices[i]]);
                double size = row.norm();
                for (std::size_t k = 0; k < interface.sharing[i].size(); ++k) {
                    const auto found = beside.find({interface.sharing[i][k], interface.index_in_sharing[i][k]});
                    for (const Index v : found != beside.end() ? found->second : std::set<Index>()) {
                        row += expected.row(v) / n_sharing[v];
                        size += expected.row(v).norm();
                    }
                }
                CHECK((rows.residual(s, i) - row).norm() <= 1e-10 * size);
            }
        }
    }
}
