#include "engine/repeated_faces_left_out.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/parallel_loop.h"
#include "partition/inspection/repeated_faces.h"

namespace seamflow {

RepeatedFacesLeftOut::RepeatedFacesLeftOut(PolygonMesh& mesh, const Topology& topology, FlowOptions& options)
    : mesh_(&mesh)
{
    if (std::ranges::find(topology.kind, VertexKind::NonManifold) == topology.kind.end())
        return;
    const auto is_suspicious = [&](Index v) { return topology.kind[at(v)] == VertexKind::NonManifold; };
    const auto candidates = select(run_in_parallel, mesh.n_faces(),
                                   [&](Index f) { return std::ranges::any_of(mesh.face(f), is_suspicious); });
    const std::vector<RepeatedFace> repeated = find_repeated_faces(mesh, candidates);
    if (repeated.empty() || options.keep_gaps)
        return;
    count_ = static_cast<Index>(repeated.size());
    number_.assign(at(mesh.n_faces()), -1);
    PolygonMesh left;
    std::vector<Index> labels;
    auto next = repeated.begin();
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        if (next != repeated.end() && next->face == f) {
            number_[at(f)] = number_[at(next++->first)];
            continue;
        }
        number_[at(f)] = left.n_faces();
        left.add_face(mesh.face(f));
        // Labels of a wrong number are refused later, with a message.
        if (at(f) < options.labels.size())
            labels.push_back(options.labels[at(f)]);
    }
    if (options.labels.size() == number_.size())
        options.labels = std::move(labels);
    face_offsets_ = std::exchange(mesh.face_offsets, std::move(left.face_offsets));
    face_vertices_ = std::exchange(mesh.face_vertices, std::move(left.face_vertices));
}

RepeatedFacesLeftOut::~RepeatedFacesLeftOut()
{
    if (count_ == 0)
        return;
    mesh_->face_offsets = std::move(face_offsets_);
    mesh_->face_vertices = std::move(face_vertices_);
}

void RepeatedFacesLeftOut::complete(FlowReport& report) const
{
    if (count_ == 0)
        return;
    report.faces += count_;
    std::vector<Index> labels(number_.size());
    std::transform(number_.begin(), number_.end(), labels.begin(),
                   [&](Index number) { return report.labels[at(number)]; });
    report.labels = std::move(labels);
    report.remarks.push_back(std::to_string(count_) + (count_ == 1 ? " face has" : " faces have") +
                             " the same vertices as one before and took no part in the flow; they are still there.");
}

}  // namespace seamflow
