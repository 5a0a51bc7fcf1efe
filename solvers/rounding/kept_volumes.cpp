#include "solvers/rounding/kept_volumes.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "partition/metrics/volume.h"
#include "partition/vector_area.h"

namespace seamflow {

KeptVolumes::KeptVolumes(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                         const Points& positions, const Executor& exec)
    : mesh_(mesh)
    , normals_(mesh, topology)
    , components_(components)
    , kept_(usize(components_.count()), 0.0)
    , component_of_(usize(mesh.n_vertices()), -1)
{
    for_each_component(exec, [&](Index c, const Executor& exec_of_faces) {
        if (encloses_volume(mesh, components_.nodes[c], exec_of_faces))
            kept_[c] = volume(c, positions, exec_of_faces);
    });
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const auto corners = topology.corners_at(v);
        const auto component = [&](Index corner) { return components_.component_of[topology.face_of[corner]]; };
        if (!corners.empty() &&
            std::ranges::all_of(corners, [&](Index corner) { return component(corner) == component(corners.front()); }))
            component_of_[v] = component(corners.front());
    });
}

template <class Body>
void KeptVolumes::for_each_component(const Executor& exec, Body&& body) const
{
    // Threads share large components face by face, and small ones one by one.
    const auto is_large = [&](Index c) { return components_.nodes[c].size() > usize(block_size); };
    for (Index c = 0; c < components_.count(); ++c)
        if (is_large(c))
            body(c, exec);
    for_each(exec, components_.count(), [&](Index c) {
        if (!is_large(c))
            body(c, run_serially);
    });
}

void KeptVolumes::restore(const Boxes& boxes, Points& positions, const Executor& exec) const
{
    // Per component: the length by which its vertices move along their normals: the missing volume by the area.
    std::vector<double> lengths(kept_.size(), 0.0);
    for_each_component(exec, [&](Index c, const Executor& exec_of_faces) {
        if (kept_[c] == 0.0)
            return;
        const std::span<const Index> faces = components_.nodes[c];
        const double area = sum(exec_of_faces, static_cast<Index>(faces.size()),
                                [&](Index i) { return vector_area(mesh_.face(faces[i]), positions).norm(); });
        if (area > 0.0)
            lengths[c] = (kept_[c] - volume(c, positions, exec_of_faces)) / area;
    });
    const Points before = positions;
    const auto motion_for = [&](Index v) -> Point {
        const Index c = component_of_[v];
        return c >= 0 && lengths[c] != 0.0 ? Point(lengths[c] * normals_(v, before)) : Point::Zero();
    };
    for_each(exec, mesh_.n_vertices(), [&](Index v) {
        Point motion = Point::Zero();
        if (copies_.size() == 0) {
            motion = motion_for(v);
        } else if (!copies_[v].empty()) {
            for (const Index copy : copies_[v])
                motion += motion_for(copy);
            motion /= static_cast<double>(copies_[v].size());
        }
        if (!motion.isZero(0.0))
            positions.row(v) = boxes.nearest(v, before.row(v) + motion);
    });
}

void KeptVolumes::share(const std::vector<Index>& original_of)
{
    std::vector<std::vector<Index>> copies(original_of.size());
    for (std::size_t v = 0; v < original_of.size(); ++v)
        copies[usize(original_of[v])].push_back(static_cast<Index>(v));
    copies_ = {};
    for (const std::vector<Index>& of_vertex : copies) {
        copies_.values.insert(copies_.values.end(), of_vertex.begin(), of_vertex.end());
        copies_.close();
    }
}

double KeptVolumes::volume(Index component, const Points& positions, const Executor& exec) const
{
    const std::span<const Index> faces = components_.nodes[component];
    const Point origin = positions.row(mesh_.face(faces.front()).front());
    return sum(exec, static_cast<Index>(faces.size()),
               [&](Index i) { return cone_volume(mesh_.face(faces[i]), positions, origin); });
}

}  // namespace seamflow
