#include "engine/fields/heat_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <utility>

#include <Eigen/Geometry>

#include "engine/fields/distance_bounds.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/laplacian/degenerate.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/virtual_refinement.h"

namespace seamflow {

namespace {

/// The largest distance to which heat diffuses, in √dt: beyond it the heat, e^-r at the distance r √dt, would vanish.
constexpr double most_diffusion_lengths = 400.0;

/// √dt in mean edge lengths. With less, the directions depend on those of edges; with more, heat smooths over ridges
/// and is bent at the boundary.
constexpr double edges_of_diffusion = 1.0;

/// The time of the step that finds the distance, in squared diagonals. M does not matter after it, so that the step
/// solves with K.
constexpr double squared_diagonals_to_rest_of_distance = 1e4;

/// Some faces of a surface, with the vertices of these faces only. The first vertex is the origin.
PolygonMesh part_of(const PolygonMesh& surface, std::span<const Index> faces, std::vector<Index>& vertices)
{
    for (const Index f : faces)
        vertices.insert(vertices.end(), surface.face(f).begin(), surface.face(f).end());
    sort_unique(vertices);
    PolygonMesh part;
    std::vector<Index> corners;
    for (const Index f : faces) {
        corners.clear();
        for (const Index v : surface.face(f))
            corners.push_back(place_in(vertices, v));
        part.add_face(corners);
    }
    part.vertices = rows_of(surface.vertices, vertices);
    const Point corner = part.vertices.row(0);
    part.vertices.rowwise() -= corner;
    return part;
}

/// The unit vector along which a linear function on a triangle decreases; 0 if there is none, or if a value is unknown.
Point descent(const std::array<Point, 3>& corners, const std::array<double, 3>& values)
{
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    Point gradient = Point::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        gradient += values[k] * normal.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3]);
    const double length = gradient.norm();
    return length > 0.0 && std::isfinite(length) ? Point(-gradient / length) : Point::Zero();
}

/// |t| X · ∇ of the hat function of each corner of a triangle t, X being the direction.
std::array<double, 3> flux(const std::array<Point, 3>& corners, const Point& direction)
{
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = normal.norm();
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3 && length > 0.0; ++k)
        result[k] = 0.5 * direction.dot(normal.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3])) / length;
    return result;
}

/// Adds ∫ X · ∇φ for the hat functions φ of the corners of a face, X being the direction in which heat decreases. It is
/// computed from the logarithm of the heat, which is nearly linear: on regular meshes this has a fifth of the error.
/// @param heat #V: its logarithm. @param of_corners receives the integral of each corner.
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
    // A polygon is a fan of triangles around its virtual vertex, whose value and hat function are means of the
    // corners'.
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

/// #V: M⁻¹ ∫ X · ∇φ for the hat function φ of each vertex, X being the direction in which heat decreases.
/// @param heat #V: its logarithm.
Eigen::VectorXd divergence(const PolygonMesh& mesh, const Topology& topology, const Eigen::VectorXd& heat)
{
    std::vector<double> of_corners(mesh.face_vertices.size());
    std::vector<double> masses(usize(mesh.n_faces()));
    for_each(run_in_parallel, mesh.n_faces(), [&](Index f) {
        const auto face = mesh.face(f);
        add_fluxes(face, mesh.vertices, heat, std::span(of_corners).subspan(usize(mesh.face_offsets[f]), face.size()));
        masses[f] = VirtualRefinement::corner_mass(VirtualRefinement::size(face, mesh.vertices), face.size());
    });
    Eigen::VectorXd result(mesh.n_vertices());
    for_each(run_in_parallel, mesh.n_vertices(), [&](Index v) {
        double sum = 0.0;
        double mass = 0.0;
        for (const Index corner : topology.corners_at(v)) {
            sum += of_corners[corner];
            mass += masses[topology.face_of[usize(corner)]];
        }
        result[v] = mass > 0.0 ? sum / mass : 0.0;
    });
    return result;
}

/// Adds a constant to the distances so that, at vertices a few edges from the sources, they agree on average with the
/// straight distances, which are nearly exact there. At the sources themselves the direction of the gradient is
/// undefined.
void shift_to_straight_distances(const PolygonMesh& mesh, const EdgePaths& paths, double edge,
                                 Eigen::VectorXd& distance)
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

/// Releases all vertices that have a row in the Laplacian.
void free_all(const PolygonMesh& mesh, Topology& topology, const Executor& exec)
{
    for (std::size_t v = 0; v < topology.kind.size(); ++v)
        topology.fixed[v] = topology.kind[v] == VertexKind::Isolated ? 1 : 0;
    fix_vertices(topology, vertices_without_row(mesh, topology, Laplacian::VirtualRefinement, exec));
}

/// A topology with the vertices at the boundary fixed, except for sources.
Topology with_fixed_boundary(Topology topology, std::span<const Index> from)
{
    const std::vector<std::uint8_t> fixed_before = topology.fixed;
    for (std::size_t v = 0; v < topology.kind.size(); ++v)
        if (topology.kind[v] == VertexKind::Boundary)
            topology.fixed[v] = 1;
    for (const Index v : from)
        topology.fixed[v] = fixed_before[v];
    return topology;
}

}  // namespace

HeatSolver::HeatSolver(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
    : n_vertices_(mesh.n_vertices())
{
    Decomposition whole = decompose(mesh, topology, std::vector<Index>(usize(mesh.n_faces()), 0), 1, exec);
    SubMesh sub_mesh = std::move(whole.sub_meshes.front());
    IndexLists faces = std::move(sub_mesh.face_vertices);
    system_.emplace(sub_mesh, std::move(faces), ScaledLaplacian{Laplacian::VirtualRefinement}, FlowTerms{},
                    run_in_parallel);
    vertices_ = std::move(sub_mesh.local_to_global);
    positions_ = rows_of(mesh.vertices, vertices_);
}

Eigen::VectorXd HeatSolver::solve(const Eigen::VectorXd& data, double time_step, const Progress& progress)
{
    progress.require_going_on();
    // The system has three columns: only the first is used.
    Points local = Points::Zero(positions_.rows(), 3);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
        local(static_cast<Eigen::Index>(v), 0) = data[vertices_[v]];
    // The system computes corrections of X. The X before is 0, so that the residual is M D, and the correction is X.
    Points x = Points::Zero(positions_.rows(), 3);
    const NeumannSystem::Assembled equations = system_->assemble(positions_, x, time_step, workspace_, &local);
    auto kept = std::ranges::find(factors_, time_step, &KeptFactor::time_step);
    // In double precision, factorise returns a factor or throws.
    if (kept == factors_.end())
        kept = factors_.insert(
            kept, {time_step, std::move(*system_->factorise(equations, Precision::Double,
                                                            *std::pmr::new_delete_resource(), workspace_.ldl))});
    Points on_interface(0, 3);
    system_->condense(equations, kept->factor, on_interface);
    system_->back_substitute(kept->factor, on_interface, x);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(n_vertices_);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
        result[vertices_[v]] = x(static_cast<Eigen::Index>(v), 0);
    return result;
}

HeatMethod::HeatMethod(const PolygonMesh& surface, std::span<const Index> faces, const Executor& exec)
    : mesh_(part_of(surface, faces, vertices_))
    , topology_(make_topology(mesh_, exec))
    , edge_(mean_edge_length(mesh_))
    , diagonal_((mesh_.vertices.colwise().maxCoeff() - mesh_.vertices.colwise().minCoeff()).norm())
{
    free_all(mesh_, topology_, exec);
    insulated_.emplace(mesh_, topology_, exec);
}

Eigen::VectorXd HeatMethod::logarithm_of_heat(std::span<const Index> from, const Progress& progress)
{
    const double length = std::max(edges_of_diffusion * edge_, diagonal_ / most_diffusion_lengths);
    Eigen::VectorXd sources = Eigen::VectorXd::Zero(mesh_.n_vertices());
    for (const Index v : from)
        sources[v] = 1.0;
    // The sum of both heats in place of their mean: a factor of the heat does not change the directions.
    Eigen::VectorXd heat = insulated_->solve(sources, length * length, progress);
    const auto is_on_boundary = [&](Index v) { return topology_.kind[v] == VertexKind::Boundary; };
    if (std::ranges::any_of(from, is_on_boundary)) {
        heat += HeatSolver(mesh_, with_fixed_boundary(topology_, from), progress.exec())
                    .solve(sources, length * length, progress);
    } else if (std::ranges::find(topology_.kind, VertexKind::Boundary) != topology_.kind.end()) {
        if (!cooled_)
            cooled_.emplace(mesh_, with_fixed_boundary(topology_, {}), progress.exec());
        heat += cooled_->solve(sources, length * length, progress);
    }
    for (double& one : heat)
        one = one > 0.0 ? std::log(one) : -std::numeric_limits<double>::infinity();
    return heat;
}

Eigen::VectorXd HeatMethod::distance(std::span<const Index> from, const Progress& progress)
{
    std::vector<Index> own;
    for (const Index v : from)
        if (const Index local = find_in(vertices_, v); local >= 0)
            own.push_back(local);
    sort_unique(own);
    const Eigen::VectorXd heat = logarithm_of_heat(own, progress);
    const double time_step = squared_diagonals_to_rest_of_distance * diagonal_ * diagonal_;
    // M is negligible beside dt K: dt X, the solution of K (dt X) = M D, is the distance up to a constant.
    Eigen::VectorXd distance = time_step * insulated_->solve(divergence(mesh_, topology_, heat), time_step, progress);
    shift_to_straight_distances(mesh_, paths_along_edges(mesh_, topology_, own), edge_, distance);
    return distance;
}

}  // namespace seamflow
