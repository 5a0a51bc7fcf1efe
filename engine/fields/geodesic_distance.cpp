#include "engine/fields/geodesic_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/fields/distance_bounds.h"
#include "engine/fields/source_components.h"
#include "engine/fields/thin_faces.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/workers.h"
#include "partition/decomposition/decomposition.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "partition/weld.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/laplacian/degenerate.h"
#include "solvers/laplacian/virtual_refinement.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

namespace {

/// Heat is e^-r at the distance r √dt. Beyond this r it would vanish among the smallest numbers.
constexpr double most_diffusion_lengths = 400.0;

/// √dt in mean edge lengths: less makes the directions depend on those of edges, more smooths over ridges and bends
/// the directions at the boundary.
constexpr double edges_of_diffusion = 1.0;

/// After this time, in squared diagonals, K alone decides.
constexpr double squared_diagonals_to_rest_of_distance = 1e4;

void require_sources(const PolygonMesh& mesh, std::span<const Index> from)
{
    if (from.empty())
        throw InputError("there is no vertex to measure distances from: name one at least");
    for (const Index v : from)
        if (v < 0 || v >= mesh.n_vertices())
            throw InputError(fmt::format("distances are wanted from vertex {}, but the mesh has {} vertices, numbered "
                                         "from 0",
                                         v, mesh.n_vertices()));
}

/// (M + dt K) X = M D on a whole mesh, for any dt, by one factorisation in double precision: far from all heat X is
/// tiny, and yet has correct digits.
class WholeMeshHeat {
  public:
    /// @param mesh, progress must outlive the object. @param topology with the vertices that have equations.
    WholeMeshHeat(const PolygonMesh& mesh, const Topology& topology, const Progress& progress)
        : mesh_(mesh)
        , progress_(progress)
    {
        Decomposition whole = decompose(mesh, topology, std::vector<Index>(at(mesh.n_faces()), 0), 1, progress.exec());
        SubMesh sub_mesh = std::move(whole.sub_meshes.front());
        IndexLists faces = std::move(sub_mesh.face_vertices);
        system_.emplace(sub_mesh, std::move(faces), ScaledLaplacian{Laplacian::VirtualRefinement});
        vertices_ = std::move(sub_mesh.local_to_global);
        positions_ = rows_of(mesh.vertices, vertices_);
    }

    /// @param data #V: D. @returns #V: X; 0 where there is no equation.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& data, double time_step)
    {
        progress_.require_going_on();
        Points local = Points::Zero(positions_.rows(), 3);
        for (std::size_t v = 0; v < vertices_.size(); ++v)
            local(static_cast<Eigen::Index>(v), 0) = data[vertices_[v]];
        Points increments = Points::Zero(positions_.rows(), 3);
        const NeumannSystem::Assembled equations =
            system_->assemble(positions_, increments, local, time_step, workspace_);
        auto factor =
            system_->factorise(equations, Precision::Double, *std::pmr::new_delete_resource(), workspace_.ldl);
        Points on_interface(0, 3);
        system_->condense(equations, *factor, on_interface);
        system_->back_substitute(*factor, on_interface, increments);
        Eigen::VectorXd result = Eigen::VectorXd::Zero(mesh_.n_vertices());
        for (std::size_t v = 0; v < vertices_.size(); ++v)
            result[vertices_[v]] = increments(static_cast<Eigen::Index>(v), 0);
        return result;
    }

  private:
    const PolygonMesh& mesh_;
    const Progress& progress_;
    std::optional<NeumannSystem> system_;
    std::vector<Index> vertices_;
    Points positions_ = Points(0, 3);
    SolverWorkspace workspace_;
};

/// The direction, of length 1, in which a linear function on a triangle decreases; 0 where there is none, or the
/// function is not known.
Point descent(const std::array<Point, 3>& corners, const std::array<double, 3>& values)
{
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    Point gradient = Point::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        gradient += values[k] * normal.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3]);
    const double length = gradient.norm();
    return length > 0.0 && std::isfinite(length) ? Point(-gradient / length) : Point::Zero();
}

/// |t| X · ∇ of the hat function of each corner of a triangle.
std::array<double, 3> flux(const std::array<Point, 3>& corners, const Point& direction)
{
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = normal.norm();
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3 && length > 0.0; ++k)
        result[k] = 0.5 * direction.dot(normal.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3])) / length;
    return result;
}

/// ∫ X · ∇φ for the hat functions φ of the corners of a face, X the direction in which heat decreases. That is where
/// its logarithm does, which is nearly linear: the error is a fifth of that with the heat itself on regular meshes.
/// @param heat #V: its logarithm.
void add_fluxes(std::span<const Index> face, const Points& positions, const Eigen::VectorXd& heat,
                std::span<double> of_corners)
{
    const std::size_t p = face.size();
    const VirtualRefinement::VirtualVertex x(face, positions);
    if (p == 3) {
        const std::array corners{x.position(0), x.position(1), x.position(2)};
        std::ranges::copy(flux(corners, descent(corners, {heat[face[0]], heat[face[1]], heat[face[2]]})),
                          of_corners.begin());
        return;
    }
    double at_virtual = 0.0;
    for (std::size_t k = 0; k < p; ++k)
        at_virtual += x.weight(k) * heat[face[k]];
    std::ranges::fill(of_corners, 0.0);
    double to_virtual = 0.0;
    for (std::size_t k = 0; k < p; ++k) {
        const std::size_t next = k + 1 == p ? 0 : k + 1;
        const std::array corners{x.position(k), x.position(next), x.position()};
        const auto fluxes = flux(corners, descent(corners, {heat[face[k]], heat[face[next]], at_virtual}));
        of_corners[k] += fluxes[0];
        of_corners[next] += fluxes[1];
        to_virtual += fluxes[2];
    }
    for (std::size_t k = 0; k < p; ++k)
        of_corners[k] += x.weight(k) * to_virtual;
}

/// M⁻¹ ∫ X · ∇φ of every vertex.
/// @param heat #V: its logarithm.
Eigen::VectorXd divergence(const PolygonMesh& mesh, const Topology& topology, const Eigen::VectorXd& heat)
{
    std::vector<double> of_corners(mesh.face_vertices.size());
    std::vector<double> masses(at(mesh.n_faces()));
    for_each(run_in_parallel, mesh.n_faces(), [&](Index f) {
        const auto face = mesh.face(f);
        add_fluxes(face, mesh.vertices, heat, std::span(of_corners).subspan(at(mesh.face_offsets[f]), face.size()));
        masses[f] = VirtualRefinement::corner_mass(VirtualRefinement::size(face, mesh.vertices), face.size());
    });
    Eigen::VectorXd result(mesh.n_vertices());
    for_each(run_in_parallel, mesh.n_vertices(), [&](Index v) {
        double sum = 0.0;
        double mass = 0.0;
        for (const Index corner : topology.corners_at(v)) {
            sum += of_corners[corner];
            mass += masses[topology.face_of[at(corner)]];
        }
        result[v] = mass > 0.0 ? sum / mass : 0.0;
    });
    return result;
}

/// Shifts the function so that it is, on average, the straight distance a few edges from where it is measured from:
/// there it is nearly exact, while right there the direction of the gradient means nothing.
void measure_from(const PolygonMesh& mesh, const EdgePaths& paths, double edge, Eigen::VectorXd& distance)
{
    constexpr double most_edges = 3.5;
    double sum = 0.0;
    double n = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (paths.from[v] >= 0 && paths.from[v] != v && paths.length[v] <= most_edges * edge) {
            sum += distance[v] - (mesh.vertices.row(v) - mesh.vertices.row(paths.from[v])).norm();
            n += 1.0;
        }
    distance.array() -= sum / std::max(n, 1.0);
}

/// Lets all vertices have equations but for those without a row.
void free_all(const PolygonMesh& mesh, Topology& topology, const Executor& exec)
{
    for (std::size_t v = 0; v < topology.kind.size(); ++v)
        topology.fixed[v] = topology.kind[v] == VertexKind::Isolated ? 1 : 0;
    hold(topology, vertices_without_row(mesh, topology, Laplacian::VirtualRefinement, exec));
}

/// Takes the equations away at the boundary, but for sources.
void hold_boundary(Topology& topology, std::span<const Index> from)
{
    const std::vector<std::uint8_t> held = topology.fixed;
    for (std::size_t v = 0; v < topology.kind.size(); ++v)
        if (topology.kind[v] == VertexKind::Boundary)
            topology.fixed[v] = 1;
    for (const Index v : from)
        topology.fixed[v] = held[v];
}

/// The heat, or its logarithm where there is any: the mean of those with a boundary that lets none through and with one
/// that takes all but at sources, which leaves the least of the boundary's own effect (section 3.4 of Crane and
/// others).
Eigen::VectorXd logarithm_of_heat(const PolygonMesh& mesh, Topology& topology, WholeMeshHeat& free,
                                  std::span<const Index> from, double time_step, const Progress& progress)
{
    Eigen::VectorXd sources = Eigen::VectorXd::Zero(mesh.n_vertices());
    for (const Index v : from)
        sources[v] = 1.0;
    Eigen::VectorXd heat = free.solve(sources, time_step);
    if (std::ranges::find(topology.kind, VertexKind::Boundary) != topology.kind.end()) {
        hold_boundary(topology, from);
        heat += WholeMeshHeat(mesh, topology, progress).solve(sources, time_step);
    }
    for (double& one : heat)
        one = one > 0.0 ? std::log(one) : -std::numeric_limits<double>::infinity();
    return heat;
}

/// The heat method, on one component.
/// @param from vertices of it.
Eigen::VectorXd distance_on(const PolygonMesh& mesh, std::span<const Index> from, const Progress& progress)
{
    Topology topology = make_topology(mesh, progress.exec());
    const double diagonal = box_of_faces(mesh, run_in_parallel).diagonal();
    const double edge = mean_edge_length(mesh);
    const double length = std::max(edges_of_diffusion * edge, diagonal / most_diffusion_lengths);
    free_all(mesh, topology, progress.exec());
    WholeMeshHeat free(mesh, topology, progress);
    const Eigen::VectorXd heat = logarithm_of_heat(mesh, topology, free, from, length * length, progress);
    const double time_step = squared_diagonals_to_rest_of_distance * diagonal * diagonal;
    Eigen::VectorXd distance = time_step * free.solve(divergence(mesh, topology, heat), time_step);
    measure_from(mesh, paths_along_edges(mesh, topology, from), edge, distance);
    return distance;
}

/// On a surface whose seams are joined.
Eigen::VectorXd distance_over(const PolygonMesh& surface, const Topology& topology, std::span<const Index> from,
                              const Progress& progress)
{
    const EdgePaths paths = paths_along_edges(surface, topology, from);
    Eigen::VectorXd distance = Eigen::Map<const Eigen::VectorXd>(paths.length.data(), surface.n_vertices());
    const PolygonMesh sound = with_faces(surface, [&](Index f) { return !is_thin(surface.face(f), surface.vertices); });
    for (const ComponentOfSources& one : components_of(sound, from)) {
        const Eigen::VectorXd of_component = one.unit * distance_on(one.mesh, one.from, progress);
        for (std::size_t i = 0; i < one.vertices.size(); ++i)
            distance[one.vertices[i]] = of_component[static_cast<Eigen::Index>(i)];
    }
    const std::vector<double> straight = straight_distances(surface, from);
    const std::vector<double> within_faces = straight_within_faces(surface, topology, from);
    for (Index v = 0; v < surface.n_vertices(); ++v)
        distance[v] = std::isfinite(within_faces[v]) ? within_faces[v]
                                                     : std::min(std::max(distance[v], straight[v]), paths.length[v]);
    return distance;
}

/// The unit of length in which squares of lengths neither overflow nor vanish: 1 for all but extreme sizes.
double sound_unit(const PolygonMesh& surface, const Topology& topology)
{
    constexpr double extreme = 0x1p300;
    double largest = 0.0;
    for (Index v = 0; v < surface.n_vertices(); ++v)
        if (!topology.corners_at(v).empty())
            largest = std::max(largest, surface.vertices.row(v).cwiseAbs().maxCoeff());
    return largest > extreme || largest < 1.0 / extreme ? power_of_two_near(largest) : 1.0;
}

/// @throws InputError
double in_unit(double distance, double unit)
{
    if (std::isfinite(distance) && std::isinf(distance * unit))
        throw InputError("distances are larger than numbers can be: give the coordinates in a larger unit");
    return distance * unit;
}

}  // namespace

Eigen::VectorXd geodesic_distance(const PolygonMesh& mesh, std::span<const Index> from,
                                  const ResourceOptions& resources, const FlowControl& control)
{
    require_valid(mesh);
    require_sources(mesh, from);
    const Topology topology = make_topology(mesh);
    const std::optional<Weld> welded = weld(mesh, topology, 0.0);
    const auto joined = [&](Index v) { return welded ? welded->first[v] : v; };
    std::vector<Index> sources;
    for (const Index v : from)
        sources.push_back(joined(v));
    sort_unique(sources);
    const Topology& topology_of_surface = welded ? welded->topology : topology;
    const double unit = sound_unit(welded ? welded->mesh : mesh, topology_of_surface);
    PolygonMesh scaled;
    if (unit != 1.0) {
        scaled = welded ? welded->mesh : mesh;
        scaled.vertices /= unit;
    }
    const PolygonMesh& surface = unit != 1.0 ? scaled : welded ? welded->mesh : mesh;
    Eigen::VectorXd of_surface;
    const Progress progress(control);
    Workers(resources.threads).execute([&] {
        of_surface = distance_over(surface, topology_of_surface, sources, progress);
    });
    Eigen::VectorXd distance(mesh.n_vertices());
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        distance[v] = in_unit(of_surface[joined(v)], unit);
    return distance;
}

}  // namespace seamflow
