#include "engine/motion/rescaling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// @throws InputError if a vertex with faces is fixed: rescaling would move it.
void require_movable(const Topology& topology, Index n_vertices)
{
    const auto held = select(run_in_parallel, n_vertices,
                             [&](Index v) { return !topology.moves(v) && topology.kind[v] != VertexKind::Isolated; });
    if (!held.empty())
        throw InputError(Wording{fmt::format(
            "rescaling moves every vertex, but {} {} held fixed, vertex {} (numbered from 0) among them, {}; or leave "
            "rescaling out and use the low-pass filter (<filter low-pass>), which hardly shrinks large features",
            held.size(), held.size() == 1 ? "is" : "are", held.front(),
            topology.kind[held.front()] == VertexKind::Boundary
                ? "which is on the boundary: let the boundary move (<boundary free>)"
                : "where the mesh is not manifold or degenerate: mend it")});
}

/// @throws InputError if the surface has a boundary, junctions, or neighbouring faces that are not oriented alike.
void require_closed(const PolygonMesh& mesh, const Topology& topology)
{
    const auto starts_at = [&](Index h) { return mesh.face_vertices[h]; };
    const auto bad = select(run_in_parallel, mesh.n_corners(), [&](Index h) {
        const Index twin = topology.twin[h];
        return twin < 0 || starts_at(h) == starts_at(twin);
    });
    if (bad.empty())
        return;
    const Index h = bad.front();
    const std::string edge = fmt::format("the edge from vertex {} to {} of face {}", starts_at(h),
                                         starts_at(topology.next(mesh, h)), topology.face_of[h]);
    if (topology.twin[h] < 0)
        throw InputError(Wording{fmt::format(
            "only a closed surface has a volume to keep, but {} lies on the boundary, or has "
            "three faces or more: close the mesh, keep its area instead (<rescale area>), or use the low-pass filter "
            "(<filter low-pass>), which hardly shrinks large features",
            edge)});
    throw InputError(fmt::format("the volume needs consistently oriented faces, but those at {} are not: orient the "
                                 "mesh, or keep its area instead",
                                 edge));
}

/// The mean of the corners of a face, relative to `origin`.
Point mean_of(std::span<const Index> corners, const Points& positions, const Point& origin)
{
    Point sum = Point::Zero();
    for (const Index v : corners)
        sum += positions.row(v) - origin;
    return sum / static_cast<double>(corners.size());
}

}  // namespace

Rescaling::Rescaling(const PolygonMesh& mesh, const Topology& topology, Rescale kind)
    : mesh_(&mesh)
    , kind_(kind)
{
    if (kind_ == Rescale::None)
        return;
    if (kind_ == Rescale::Volume)
        require_closed(mesh, topology);
    require_movable(topology, mesh.n_vertices());
    components_ = surface_components(mesh, run_in_parallel);
    origins_.assign(usize(components_.count()), -1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (const Index c = components_.of_vertex[v]; c >= 0 && origins_[c] < 0)
            origins_[c] = v;
    for (Index c = 0; c < components_.count(); ++c)
        initial_.push_back(measure(c, mesh.vertices));
    const auto is_sound = [&](const Extent& extent) { return has_size(extent); };
    if (mesh.n_faces() > 0 && std::ranges::none_of(initial_, is_sound))
        throw InputError(fmt::format("the surface has no {} above rounding: scale the mesh, or leave rescaling out",
                                     kind_ == Rescale::Area ? "area" : "volume"));
}

/// Whether the area or volume of a component is more than rounding: regions whose volumes cancel each other leave a
/// volume that is small compared with the area to the power 3/2.
bool Rescaling::has_size(const Extent& extent) const
{
    const double least = kind_ == Rescale::Volume ? 1e-12 * extent.area * std::sqrt(extent.area) : 0.0;
    return std::isnormal(extent.size) && std::abs(extent.size) > least && extent.centroid.allFinite();
}

Rescaling::Extent Rescaling::measure(Index component, const Points& positions) const
{
    const Point origin = positions.row(origins_[component]);
    const std::span<const Index> faces = components_.faces[component];
    const auto n = static_cast<Index>(faces.size());
    // There can be very many small components: for each of them, sharing the work among threads would cost more than it
    // saves.
    const Executor exec = n > block_size ? Executor(run_in_parallel) : Executor(run_serially);
    const auto add_up = [&](auto&& of_face) {
        return sum(exec, n, [&](Index i) {
            const auto corners = mesh_->face(faces[i]);
            return of_face(vector_area(corners, positions), mean_of(corners, positions, origin));
        });
    };
    const double area = add_up([](const Point& normal, const Point&) { return normal.norm(); });
    Point centroid;
    for (int c = 0; c < 3; ++c)
        centroid[c] = add_up([c](const Point& normal, const Point& mean) { return normal.norm() * mean[c]; }) / area;
    const double size = kind_ == Rescale::Area ? area : add_up([&](const Point& normal, const Point& mean) {
        return normal.dot(mean - centroid) / 3.0;
    });
    return {area, size, origin + centroid};
}

/// The map that scales a component back.
/// @returns a scale of 0 if too little of the component is left.
Similarity Rescaling::back(const Extent& first, const Extent& now) const
{
    const double ratio = first.size / now.size;
    // The size that a component must have left, in rounding errors of its coordinates: four digits.
    constexpr double least_size_in_roundings = 1e4;
    const double farthest = now.centroid.cwiseAbs().maxCoeff() + std::sqrt(now.area);
    const double rounding = std::numeric_limits<double>::epsilon() * farthest;
    const bool sound = std::isnormal(ratio) && ratio > 0.0 && now.centroid.allFinite();
    if (!sound || !has_size(first) || !(std::sqrt(now.area) > least_size_in_roundings * rounding))
        return {.scale = 0.0};
    return {now.centroid, kind_ == Rescale::Area ? std::sqrt(ratio) : std::cbrt(ratio), first.centroid};
}

SimilarityOfComponents Rescaling::apply(Points& positions)
{
    SimilarityOfComponents all{components_.of_vertex, {}};
    if (kind_ == Rescale::None || mesh_->n_faces() == 0)
        return all;
    n_left_ = 0;
    for (Index c = 0; c < components_.count(); ++c) {
        Similarity similarity = back(initial_[c], measure(c, positions));
        if (similarity.scale == 0.0) {
            ++n_left_;
            similarity = {};
        }
        all.maps.push_back(similarity);
    }
    if (n_left_ == components_.count())
        throw ComputationError(
            "too little is left of the surface to scale it back to its size: use a smaller time step or fewer steps");
    for_each(run_in_parallel, mesh_->n_vertices(), [&](Index v) {
        if (components_.of_vertex[v] >= 0)
            positions.row(v) = all(v, positions.row(v));
    });
    return all;
}

std::optional<Remark> Rescaling::remark() const
{
    if (n_left_ == 0)
        return {};
    return Remark("not rescaled", {{"components", n_left_}, {"of", components_.count()}},
                  {fmt::format("{} of {} components {} not scaled back: {} no {} above rounding, at first or in the "
                               "end.",
                               n_left_, components_.count(), n_left_ == 1 ? "was" : "were",
                               n_left_ == 1 ? "it has" : "they have", kind_ == Rescale::Area ? "area" : "volume")});
}

}  // namespace seamflow
