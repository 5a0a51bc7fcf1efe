#include "engine/geodesic_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/fields/distance_bounds.h"
#include "engine/fields/field_columns.h"
#include "engine/fields/heat_method.h"
#include "engine/surface/flowing_mesh.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/surface_components.h"
#include "partition/topology.h"
#include "partition/with_faces.h"
#include "solvers/direct/ldl_solver.h"

namespace seamflow {

namespace {

/// @throws InputError for no sources, or sources that do not exist.
void require_sources(Index n_vertices, std::span<const Index> from)
{
    if (from.empty())
        throw InputError("there is no vertex to measure distances from: name one at least");
    for (const Index v : from)
        if (v < 0 || v >= n_vertices)
            throw InputError(fmt::format("distances are wanted from vertex {}, but the mesh has {} vertices, numbered "
                                         "from 0",
                                         v, n_vertices));
}

/// Calls action(v, w, length) for the edges of all faces. Lengths are in units of 4, so that those between the largest
/// coordinates do not overflow.
template <class Action>
void for_each_edge(const PolygonMesh& mesh, Action&& action)
{
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        Index v = mesh.face(f).back();
        for (const Index w : mesh.face(f)) {
            action(v, w, (0.25 * mesh.vertices.row(w) - 0.25 * mesh.vertices.row(v)).stableNorm());
            v = w;
        }
    }
}

/// A power of two near the median length of the edges that have a length; 1 if no edge has one.
double median_unit(const PolygonMesh& mesh)
{
    std::vector<double> lengths;
    for_each_edge(mesh, [&](Index, Index, double length) {
        if (length > 0.0)
            lengths.push_back(length);
    });
    if (lengths.empty())
        return 1.0;
    const auto median = lengths.begin() + std::ssize(lengths) / 2;
    std::ranges::nth_element(lengths, median);
    return 4.0 * power_of_two_near(*median);
}

/// A copy with coordinates in this unit. Vertices without faces are at 0, because they can be so far away that their
/// coordinates overflow.
PolygonMesh in_units(const PolygonMesh& mesh, double unit)
{
    PolygonMesh scaled = mesh;
    scaled.vertices /= unit;
    for (Index v = 0; v < scaled.n_vertices(); ++v)
        if (!scaled.vertices.row(v).allFinite())
            scaled.vertices.row(v).setZero();
    return scaled;
}

/// Refuses a surface whose lengths of edges differ too much.
/// @throws InputError naming the vertex whose distance to its nearest neighbour differs most from the median edge.
[[noreturn]] void refuse_uneven(const PolygonMesh& surface)
{
    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Index vertex = -1;
    };
    std::vector<Nearest> nearest(usize(surface.n_vertices()));
    for_each_edge(surface, [&](Index v, Index w, double quarter) {
        for (const auto& [from, to] : {std::pair(v, w), std::pair(w, v)})
            if (quarter > 0.0 && 4.0 * quarter < nearest[from].distance)
                nearest[from] = {4.0 * quarter, to};
    });
    const double unit = median_unit(surface);
    const auto unevenness = [&](const Nearest& n) {
        return n.vertex < 0 ? 0.0 : std::abs(std::log(n.distance / unit));
    };
    const auto worst = std::ranges::max_element(nearest, {}, unevenness);
    throw InputError(fmt::format("distances cannot be computed, because the lengths of edges differ too much: vertex "
                                 "{} (numbered from 0) is {:.3g} median edges from its nearest neighbour, {}: {}",
                                 worst - nearest.begin(), worst->distance / unit, worst->vertex,
                                 worst->distance > unit ? "remove it, or move it to the others" : "merge them"));
}

/// Converts a distance in multiples of `unit` to length.
/// @throws InputError if it overflows.
double in_unit(double distance, double unit)
{
    if (std::isfinite(distance) && std::isinf(distance * unit))
        throw InputError("distances are larger than numbers can be: give the coordinates in a larger unit");
    return distance * unit;
}

}  // namespace

/// The surface in units in which the median edge is about 1, so that squares of lengths neither overflow nor vanish.
class Geodesics::Surface {
  public:
    explicit Surface(const PolygonMesh& mesh)
        : unit_(median_unit(mesh))
        , given_(in_units(mesh, unit_))
        , flowing_(given_)
        , topology_(make_topology(flowing_.mesh(), run_in_parallel))
    {
        MotionOptions motion;
        flowing_.weld_seams(topology_, motion, run_in_parallel);
        if (flowing_.leave_out_repeated_faces(topology_))
            topology_ = make_topology(flowing_.mesh(), run_in_parallel);
        sound_ = with_faces(surface(), [&](Index f) { return !is_thin(surface().face(f), surface().vertices); });
        components_ = surface_components(sound_, run_in_parallel);
        heat_methods_.resize(usize(components_.count()));
    }

    [[nodiscard]] Index n_vertices() const { return given_.n_vertices(); }

    /// #V: the distances from the nearest of the sources `from`, in length. Those of the heat method are kept between
    /// straight distances and paths along edges; within faces that have a source, distances are straight.
    Eigen::VectorXd distance(std::span<const Index> from, const Progress& progress)
    {
        std::vector<Index> sources;
        for (const Index v : from)
            sources.push_back(flowing_.moves_with(v));
        std::ranges::sort(sources);
        const EdgePaths paths = paths_along_edges(surface(), topology_, sources);
        Eigen::VectorXd distance = Eigen::Map<const Eigen::VectorXd>(paths.length.data(), n_vertices());
        measure_by_heat(sources, progress, distance);
        const std::vector<double> straight = straight_distances(surface(), sources);
        const std::vector<double> within_faces = straight_within_faces(surface(), topology_, sources);
        for (Index v = 0; v < n_vertices(); ++v)
            distance[v] = std::isfinite(within_faces[v])
                              ? within_faces[v]
                              : std::min(std::max(distance[v], straight[v]), paths.length[v]);
        Eigen::VectorXd result(n_vertices());
        for (Index v = 0; v < n_vertices(); ++v)
            result[v] = in_unit(distance[flowing_.moves_with(v)], unit_);
        return result;
    }

  private:
    [[nodiscard]] const PolygonMesh& surface() const { return flowing_.mesh(); }

    /// Measures the distances by the heat method, in each component of the surface that has sources.
    /// @param distance #V: receives the distances at the vertices of these components.
    void measure_by_heat(std::span<const Index> sources, const Progress& progress, Eigen::VectorXd& distance)
    {
        std::vector<Index> with_sources;
        for (const Index source : sources)
            if (const Index c = components_.of_vertex[source]; c >= 0)
                with_sources.push_back(c);
        sort_unique(with_sources);
        for (const Index c : with_sources) {
            std::unique_ptr<HeatMethod>& method = heat_methods_[c];
            if (!method)
                method = std::make_unique<HeatMethod>(sound_, components_.faces[c], progress.exec());
            try {
                const Eigen::VectorXd of_component = method->distance(sources, progress);
                for (std::size_t i = 0; i < method->vertices().size(); ++i)
                    distance[method->vertices()[i]] = of_component[static_cast<Eigen::Index>(i)];
            } catch (const ComputationError&) {
                refuse_uneven(surface());
            }
        }
    }

    double unit_;
    PolygonMesh given_;
    FlowingMesh flowing_;
    Topology topology_;
    /// The mesh without faces that have no area.
    PolygonMesh sound_;
    SurfaceComponents components_;
    /// Per component: its heat method, once it has been asked for; null before.
    std::vector<std::unique_ptr<HeatMethod>> heat_methods_;
};

Geodesics::Geodesics(const PolygonMesh& mesh, const ResourceOptions& resources)
    : resources_(resources)
{
    require_valid(mesh);
    Workers(resources.threads).execute([&] { surface_ = std::make_unique<Surface>(mesh); });
}

Geodesics::~Geodesics() = default;

Eigen::VectorXd Geodesics::distance(std::span<const Index> from, const FlowControl& control)
{
    require_sources(surface_->n_vertices(), from);
    const Progress progress(control);
    Eigen::VectorXd distance;
    Workers(resources_.threads).execute([&] { distance = surface_->distance(from, progress); });
    return distance;
}

Eigen::VectorXd geodesic_distance(const PolygonMesh& mesh, std::span<const Index> from,
                                  const ResourceOptions& resources, const FlowControl& control)
{
    return Geodesics(mesh, resources).distance(from, control);
}

}  // namespace seamflow
