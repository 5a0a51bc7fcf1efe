#include "solvers/denoising/vertex_averages.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "partition/parallel_lists.h"

namespace seamflow {

VertexAverages::VertexAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
    : mesh_(&mesh)
    , topology_(&topology)
{
    make_lists_in_parallel(
        exec, mesh.n_vertices(), [&](Index v, std::vector<Index>& list) { edge_neighbours(mesh, topology, v, list); },
        neighbours_.offsets, neighbours_.values);
}

void VertexAverages::spread(Rows& near, Rows& around, int rounds, int further_rounds, const Executor& exec) const
{
    // Columns are spread in groups of this size, which fill registers and take little memory.
    constexpr int width = 16;
    constexpr int small_width = 4;
    if (near.cols() <= small_width)
        return spread_columns<small_width>(near, around, 0, rounds, further_rounds, exec);
    for (Eigen::Index first = 0; first < near.cols(); first += width)
        spread_columns<width>(near, around, first, rounds, further_rounds, exec);
}

template <int Width>
void VertexAverages::spread_columns(Rows& near, Rows& around, Eigen::Index first, int rounds, int further_rounds,
                                    const Executor& exec) const
{
    using NarrowRow = Eigen::Matrix<float, 1, Width>;
    using NarrowRows = Eigen::Matrix<float, Eigen::Dynamic, Width, Eigen::RowMajor>;
    const Index n_vertices = neighbours_.size();
    NarrowRows now(n_vertices, Width);
    NarrowRows before(n_vertices, Width);
    const Eigen::Index n = std::min<Eigen::Index>(Width, near.cols() - first);
    const auto to_faces = [&](Rows& of_faces) {
        for_each(exec, mesh_->n_faces(), [&](Index f) {
            NarrowRow total = NarrowRow::Zero();
            for (const Index v : mesh_->face(f))
                total += now.row(v);
            of_faces.row(f).segment(first, n) = (total / static_cast<float>(mesh_->face(f).size())).head(n);
        });
    };
    for_each(exec, n_vertices, [&](Index v) {
        NarrowRow total = NarrowRow::Zero();
        const auto corners = topology_->corners_at(v);
        for (const Index corner : corners)
            total.head(n) += near.row(topology_->face_of[corner]).segment(first, n);
        now.row(v) = total / static_cast<float>(std::max(corners.size(), std::size_t{1}));
    });
    for (int round = 1; round <= rounds + further_rounds; ++round) {
        now.swap(before);
        for_each(exec, n_vertices, [&](Index v) {
            NarrowRow total = before.row(v);
            for (const Index w : neighbours_[v])
                total += before.row(w);
            now.row(v) = total / static_cast<float>(1 + neighbours_[v].size());
        });
        if (round == rounds)
            to_faces(near);
    }
    to_faces(around);
}

}  // namespace seamflow
