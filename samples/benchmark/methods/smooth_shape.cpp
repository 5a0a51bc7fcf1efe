#include "samples/benchmark/methods/smooth_shape.h"

#define CGAL_EIGEN3_ENABLED 1
#include <algorithm>
#include <cstddef>

#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;

SurfaceMesh to_surface_mesh(const PolygonMesh& mesh)
{
    SurfaceMesh surface;
    surface.reserve(static_cast<unsigned>(mesh.n_vertices()), static_cast<unsigned>(mesh.n_corners()),
                    static_cast<unsigned>(mesh.n_faces()));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        surface.add_vertex({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
    const auto vertex = [](Index v) { return Vertex(static_cast<unsigned>(v)); };
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto corners = mesh.face(f);
        if (corners.size() != 3)
            throw ComputationError("left out: smooth_shape takes triangles only");
        if (surface.add_face(vertex(corners[0]), vertex(corners[1]), vertex(corners[2])) == SurfaceMesh::null_face())
            throw ComputationError("left out: smooth_shape takes manifold meshes of faces oriented alike only");
    }
    return surface;
}

/// smooth_shape gives each vertex half of its area, and each edge the sum of its cotangents: with a quarter of dt that
/// is the equation of Alexa-Wardetzky, both sides multiplied by half of the area.
constexpr double time_of_time_step = 0.25;

/// With fewer, smooth_shape scales the mesh.
constexpr std::ptrdiff_t fewest_fixed_without_scaling = 2;

}  // namespace

MethodResult run_smooth_shape(const PolygonMesh& mesh, const MethodTask& task)
{
    namespace parameters = CGAL::parameters;
    MethodResult result;
    Stopwatch watch;
    const Topology topology = make_topology(mesh);
    SurfaceMesh surface = to_surface_mesh(mesh);
    auto is_fixed = surface.add_property_map<Vertex, bool>("v:fixed", true).first;
    for (const Vertex v : surface.vertices())
        is_fixed[v] = topology.kind[v.idx()] != VertexKind::Interior;
    result.setup_seconds = watch.lap();
    for (int step = 0; step < task.options.steps; ++step) {
        CGAL::Polygon_mesh_processing::smooth_shape(
            surface, time_of_time_step * task.options.time_step,
            parameters::number_of_iterations(1).vertex_is_constrained_map(is_fixed));
        result.steps.push_back({.total = watch.lap()});
    }
    const auto n_fixed = std::count_if(surface.vertices().begin(), surface.vertices().end(),
                                       [&](Vertex v) { return bool{is_fixed[v]}; });
    if (task.options.laplacian != Laplacian::AlexaWardetzky || n_fixed < fewest_fixed_without_scaling)
        return result;
    result.positions.resize(mesh.n_vertices(), 3);
    for (const Vertex v : surface.vertices()) {
        const auto& point = surface.point(v);
        result.positions.row(static_cast<Eigen::Index>(v.idx())) << point.x(), point.y(), point.z();
    }
    return result;
}

}  // namespace seamflow
