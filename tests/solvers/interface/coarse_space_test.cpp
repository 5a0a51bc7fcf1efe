#include <map>
#include <set>

#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/interface/coarse_space.h"
#include "solvers/systems/neumann_system.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/heap.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// S x over all sub-meshes.
Points product(const InterfaceCopies& copies, const std::vector<DenseFactor>& complements, const Points& x)
{
    Points result = Points::Zero(x.rows(), 3);
    for (Index s = 0; s < copies.n_sub_meshes(); ++s) {
        const std::size_t room = DenseFactor::room(copies.n_in(s));
        AlignedFloats numbers;
        numbers.assign(6 * room);
        const auto of = [&](std::size_t column, Index i) -> float& { return numbers.data()[column * room + usize(i)]; };
        for (Index i = 0; i < copies.n_in(s); ++i)
            for (Index c = 0; c < 3; ++c)
                of(usize(c), i) = static_cast<float>(x(copies.vertex[copies.offsets[s] + i], c));
        complements[s].multiply(columns_at(numbers.data(), room), columns_at(numbers.data() + 3 * room, room));
        for (Index i = 0; i < copies.n_in(s); ++i)
            for (Index c = 0; c < 3; ++c)
                result(copies.vertex[copies.offsets[s] + i], c) += complements[s].scale() * of(usize(c) + 3, i);
    }
    return result;
}

}  // namespace

TEST_CASE("what is left of the residual after the correction has no part along any sub-mesh's weights on a stretch")
{
    RandomNumbers random(5);
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const InterfaceCopies copies(decomposition);
        std::vector<DenseFactor> complements;
        for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
            const NeumannSystem system(sub_mesh, sub_mesh.face_vertices, Laplacian::Fujiwara);
            const Points increments = Points::Zero(sub_mesh.n_vertices, 3);
            const auto equations = system.assemble(localised(sub_mesh, cut.mesh.vertices), increments, 0.05, workspace);
            const auto factor = system.factorise(equations, Precision::Single, heap(), workspace.ldl);
            system.take_schur_complement(*factor, workspace.ldl, complements.emplace_back());
        }
        std::vector<double> weights(copies.n_copies());
        std::map<std::vector<Index>, Index> classes;
        for (Index v = 0; v < copies.n_vertices(); ++v) {
            double sum = 0.0;
            std::vector<Index> sharing;
            for (const Index copy : copies.of_vertex[v]) {
                sum += weights[copy] = 1.5 + random.symmetric();
                sharing.push_back(copies.sub_mesh[copy]);
            }
            for (const Index copy : copies.of_vertex[v])
                weights[copy] /= sum;
            ++classes[sharing];
        }
        OneRank all(copies.n_sub_meshes());
        CoarseSpace coarse(copies, all);
        Index n_functions = 0;
        for (const auto& [sharing, length] : classes)
            n_functions += length > 1 ? static_cast<Index>(sharing.size()) : 1;
        CHECK(coarse.size() == n_functions);

        coarse.prepare(complements, weights, run_serially);
        Points residual(copies.n_vertices(), 3);
        Points y(copies.n_vertices(), 3);
        for (Points* points : {&residual, &y})
            for (double& value : points->reshaped())
                value = random.symmetric();
        coarse.correct(residual, y, run_serially);
        const Points left = residual - product(copies, complements, y);
        std::map<std::pair<std::vector<Index>, Index>, Point> sums;
        for (Index v = 0; v < copies.n_vertices(); ++v) {
            std::vector<Index> sharing;
            for (const Index copy : copies.of_vertex[v])
                sharing.push_back(copies.sub_mesh[copy]);
            for (const Index copy : copies.of_vertex[v])
                sums.try_emplace({sharing, copies.sub_mesh[copy]}, Point::Zero()).first->second +=
                    weights[copy] * left.row(v);
        }
        for (const auto& [piece, sum] : sums)
            CHECK(sum.norm() < 2e-4 * left.norm());
    }
}
