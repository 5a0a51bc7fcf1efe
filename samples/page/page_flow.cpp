#include "samples/page/page_flow.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/measure/surface_measures.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/page/packed_array.h"
#include "samples/page/shown_steps.h"

namespace seamflow {

namespace {

/// Not finite where `unit` is 0.
PackedValues pack_distances(const Points& from, const Points& to, double unit)
{
    std::vector<double> distances(static_cast<std::size_t>(to.rows()));
    for (Eigen::Index v = 0; v < to.rows(); ++v)
        distances[static_cast<std::size_t>(v)] = (to.row(v) - from.row(v)).norm() / unit;
    return pack_values(distances);
}

}  // namespace

PageMesh::PageMesh(const PolygonMesh& input, FileColours own_colours)
    : mesh(input)
    , topology(make_topology(mesh, run_in_parallel))
    , mean_edge(mean_edge_length(mesh))
    , colours(std::move(own_colours))
{
}

PackedPoints PageMesh::pack(Points positions) const
{
    for (Index v = 0; v < mesh.n_vertices() && mesh.n_faces() > 0; ++v)
        if (topology.corners_at(v).empty())
            positions.row(v) = positions.row(mesh.face_vertices.front()).eval();
    return pack_points(positions);
}

PageFlow::PageFlow(std::shared_ptr<const PageMesh> mesh, std::string name, Laplacian laplacian, int steps,
                   bool undecomposed)
    : mesh_(std::move(mesh))
    , name_(std::move(name))
    , laplacian_(laplacian)
    , steps_(steps)
    , undecomposed_(undecomposed)
    , shown_(shown_steps(steps, mesh_->mesh.n_vertices(), undecomposed))
{
    PageState& input = states_.emplace_back();
    input.surface = pack_surface(mesh_->mesh.vertices);
    input.distance = pack_values(std::vector<double>(mesh_->mesh.n_vertices(), 0.0));
}

PageSurface PageFlow::pack_surface(const Points& positions) const
{
    return {.positions = mesh_->pack(positions),
            .curvature = pack_values(measure_curvature(mesh_->mesh, mesh_->topology, positions, laplacian_))};
}

void PageFlow::add_step(int step, const Points& positions, const Points* undecomposed)
{
    if (!std::binary_search(shown_.begin(), shown_.end(), step))
        return;
    PageState& state = states_.emplace_back();
    state.step = step;
    state.surface = pack_surface(positions);
    if (undecomposed == nullptr) {
        state.distance = pack_distances(mesh_->mesh.vertices, positions, mesh_->mean_edge);
        return;
    }
    state.undecomposed = pack_surface(*undecomposed);
    state.distance =
        pack_distances(*undecomposed, positions, mean_edge_length(mesh_->mesh, *undecomposed, run_in_parallel));
}

void PageFlow::finish(const FlowReport& report, std::string report_json)
{
    labels_ = report.cut.labels;
    const std::vector<std::uint32_t> labels(labels_.begin(), labels_.end());
    packed_labels_ = packed(std::span<const std::uint32_t>(labels), 1);
    report_json_ = std::move(report_json);
}

std::string PageFlow::remark() const
{
    return remark_on_shown_steps(steps_, static_cast<int>(states_.size()) - 1);
}

}  // namespace seamflow
