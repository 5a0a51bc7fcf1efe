#include "samples/report/rank_roughness.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"
#include "samples/meshes/surface_sample.h"

namespace seamflow {

namespace {

/// A corner of a face of the sample, as numbered in the whole mesh.
struct SampledCorner {
    std::int64_t face;
    std::int64_t vertex;
    std::array<double, 3> position;
};

}  // namespace

RankRoughness::RankRoughness(const MeshPart& part, std::int64_t n_vertices)
    : part_(&part)
    , sample_(select(run_in_parallel, part.mesh.n_faces(), [&](Index f) {
        return std::ranges::any_of(part.mesh.face(f), [&](Index v) {
            return is_sampled(static_cast<Index>(part.vertex_numbers[v]), static_cast<Index>(n_vertices));
        });
    }))
{
}

std::optional<Roughness> RankRoughness::measure(Communicator& comm) const
{
    std::vector<SampledCorner> corners;
    for (const Index f : sample_)
        for (const Index v : part_->mesh.face(f))
            corners.push_back({part_->face_numbers[f],
                               part_->vertex_numbers[v],
                               {part_->mesh.vertices(v, 0), part_->mesh.vertices(v, 1), part_->mesh.vertices(v, 2)}});
    corners = comm.gather_at_first(corners);
    if (corners.empty())
        return {};
    // In the order of the whole mesh; those of a face stay in theirs.
    std::ranges::stable_sort(corners, {}, &SampledCorner::face);
    std::vector<Index> vertices;
    for (const SampledCorner& corner : corners)
        vertices.push_back(static_cast<Index>(corner.vertex));
    sort_unique(vertices);
    Points positions(std::ssize(vertices), 3);
    IndexLists faces;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if (c > 0 && corners[c].face != corners[c - 1].face)
            faces.close();
        faces.values.push_back(static_cast<Index>(corners[c].vertex));
        positions.row(std::ranges::lower_bound(vertices, faces.values.back()) - vertices.begin()) =
            Point(corners[c].position.data());
    }
    faces.close();
    return roughness(extract(faces, vertices), positions);
}

}  // namespace seamflow
