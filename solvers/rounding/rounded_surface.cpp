#include "solvers/rounding/rounded_surface.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/connected_components.h"
#include "partition/metrics/edge_measures.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/common_drift.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "solvers/rounding/joined_copies.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/missing_data.h"
#include "solvers/rounding/rounding_evidence.h"
#include "solvers/rounding/smoothest_normals.h"
#include "solvers/rounding/surface_parts.h"
#include "solvers/rounding/uncrossed_faces.h"

namespace seamflow {

namespace {

/// A fairing ends when no coordinate moves by more than this many steps in an iteration.
constexpr double last_motion = 0.002;
constexpr int most_iterations = 400;

bool begins_with_fairing(const CoordinateBounds& bounds)
{
    return bounds.kind != CoordinateBounds::Kind::MarchingCubes || !has_equal_steps(bounds.steps);
}

/// A surface whose vertices move: that with copies joined, or the surface itself.
struct MovingSurface {
    const PolygonMesh& mesh;
    const Topology& topology;
    /// #V: the vertices that share an edge with each vertex.
    IndexLists neighbours;
    /// Null without copies.
    const JoinedCopies* joined;

    MovingSurface(const PolygonMesh& of, const Topology& with, const JoinedCopies* of_copies, const Executor& exec)
        : mesh(of)
        , topology(with)
        , neighbours(VertexAverages(of, with, exec).neighbours())
        , joined(of_copies)
    {
    }

    /// Gives copies of a vertex its values, #V by 3.
    void copy_to_copies(Points& values) const
    {
        if (joined == nullptr)
            return;
        for (std::size_t v = 0; v < joined->original_of.size(); ++v)
            values.row(static_cast<Eigen::Index>(v)) = Point(values.row(joined->original_of[v]));
    }
};

/// #V: the fraction of its bounds that a vertex gets.
/// @param topology of the surface before copies are joined.
std::vector<double> fractions_of_bounds(const Topology& topology, const JoinedCopies* joined,
                                        const RoundedMotion& motion, Index n_vertices)
{
    std::vector<double> fractions(usize(n_vertices));
    for (Index v = 0; v < n_vertices; ++v)
        fractions[v] = !topology.moves(v) ? 0.0 : motion.strengths.empty() ? 1.0 : motion.strengths[v];
    if (joined == nullptr)
        return fractions;
    for (Index v = 0; v < n_vertices; ++v)
        fractions[joined->original_of[v]] = std::min(fractions[joined->original_of[v]], fractions[v]);
    for (const Index v : joined->ambiguous)
        fractions[v] = 0.0;
    return fractions;
}

/// The bounds of vertices that may move.
/// @param parts those before copies are joined. @param fractions #V: the fraction of its bounds that each vertex gets.
CoordinateBounds bounds_for(const MovingSurface& surface, const SurfaceParts& parts, const Points& positions,
                            const std::vector<double>& fractions, const RoundedMotion& motion, const Executor& exec)
{
    const SizeOfParts size_of_parts = [&](const std::function<bool(Index)>& counts) {
        return size_of(surface.mesh, positions, counts, exec);
    };
    std::vector<Index> part_of;
    if (parts.count() > 1) {
        part_of.resize(usize(static_cast<Index>(positions.rows())));
        for_each(exec, static_cast<Index>(positions.rows()), [&](Index v) { part_of[v] = parts.of_vertex(v); });
    }
    CoordinateBounds bounds = motion.given_steps
                                  ? bounds_of(positions, surface.neighbours, size_of_parts, *motion.given_steps, exec)
                                  : bounds_of(positions, surface.neighbours, part_of, size_of_parts, exec);
    if (bounds.kind == CoordinateBounds::Kind::None)
        return bounds;
    for_each(exec, static_cast<Index>(positions.rows()), [&](Index v) {
        bounds.half_widths.row(v) = fractions[v] * bounds.half_widths.row(v).cwiseProduct(motion.axes);
    });
    surface.copy_to_copies(bounds.half_widths);
    // Where sheets meet, terraces end at other sheets, which says nothing of how flat their own is.
    if (!surface.topology.junctions.empty())
        bounds.flat.clear();
    return bounds;
}

/// Smooths a surface within bounds.
class SmoothingInBounds {
  public:
    /// @param mesh, topology before copies are joined. @param parts of the mesh. @param surface that moves.
    /// @param positions #V by 3. All must outlive the object.
    SmoothingInBounds(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                      const SurfaceParts& parts, const MovingSurface& surface, const Points& positions,
                      const Executor& exec)
        : surface_(surface)
        , positions_(positions)
        , exec_(exec)
        , parts_(parts)
        , volumes_(surface.joined != nullptr ? surface.joined->all_faces : mesh, topology, components, positions, exec)
    {
        explained_.assign(usize(parts_.count()), 1);
        if (surface.joined != nullptr)
            volumes_.share(surface.joined->original_of);
    }

    /// @param judges whether it is judged which parts move: those whose roughness rounding explains. Otherwise those
    /// of the last judgement move, or all.
    /// @returns nothing if there are none. `spikes` is empty.
    std::optional<SmoothedWithinSteps> smooth(CoordinateBounds bounds, bool judges)
    {
        if (!judges)
            hold_others(bounds.half_widths);
        const Boxes boxes{positions_, bounds.half_widths, bounds.flat, bounds.furthest};
        SmoothedWithinSteps result{.positions = positions_, .steps = bounds.steps};
        const double smallest_step =
            (bounds.steps.array() > 0.0).select(bounds.steps, bounds.steps.maxCoeff()).minCoeff();
        if (begins_with_fairing(bounds))
            result.fairing = fair_in_boxes(surface_.neighbours, boxes, {most_iterations, last_motion * smallest_step},
                                           result.positions, exec_);
        result.fairing.last_motion /= smallest_step;
        const Points fair = result.positions;
        SmoothestNormals normals(surface_.mesh, surface_.topology, volumes_, boxes, bounds.kind, exec_);
        normals.smooth(result.positions);
        surface_.copy_to_copies(result.positions);
        if (judges) {
            // Thin vessels beside others lose a part of their volume.
            explained_ =
                parts_explained_by_rounding(parts_, bounds, boxes, result.positions, surface_.joined == nullptr, exec_);
            if (std::ranges::find(explained_, 1) == explained_.end())
                return std::nullopt;
        }
        take_back_drift_within(bounds, boxes, normals, result.positions);
        result.is_smoothed = hold_others(bounds.half_widths);
        for_each(exec_, static_cast<Index>(positions_.rows()),
                 [&](Index v) { result.positions.row(v) = boxes.nearest(v, result.positions.row(v)); });
        uncross_faces(surface_.mesh, surface_.topology, fair, boxes, result.positions, exec_);
        surface_.copy_to_copies(result.positions);
        return result;
    }

  private:
    /// Takes back the drift of voxels and marching cubes of equal steps, and where many vertices have drifted, smooths
    /// what is not thin once more. Terraces of heights and between slices are so wide that neighbours lie on one side
    /// by rounding.
    void take_back_drift_within(const CoordinateBounds& bounds, const Boxes& boxes, SmoothestNormals& normals,
                                Points& positions) const
    {
        const bool is_marching_cubes = bounds.kind == CoordinateBounds::Kind::MarchingCubes;
        if (bounds.kind == CoordinateBounds::Kind::Heights || !has_equal_steps(bounds.steps))
            return;
        // Egg crates of 3 and 4 voxels: 0.099 to 0.175 voxels from the truth become 0.07 to 0.15, by marching cubes
        // 0.154 to 0.196 become 0.09 to 0.12. A ball of radius 16 stays at 0.026.
        const int rounds = is_marching_cubes ? 16 : 40;
        const double by_chance = (is_marching_cubes ? 0.03 : 0.04) * bounds.steps.maxCoeff();
        const auto take_back = [&](Points& drifted) {
            const std::vector<Index> vertices = take_back_drift(surface_.mesh, surface_.topology, surface_.neighbours,
                                                                boxes, rounds, by_chance, drifted, exec_);
            volumes_.restore(boxes, drifted, exec_);
            surface_.copy_to_copies(drifted);
            return vertices;
        };
        normals.smooth_again(take_back(positions), take_back, positions);
        surface_.copy_to_copies(positions);
    }

    /// Takes the bounds of vertices of the parts that are not explained, and of all their copies.
    /// @returns #F: 1 in the other parts.
    std::vector<std::uint8_t> hold_others(Points& half_widths) const
    {
        const PolygonMesh& mesh = parts_.mesh();
        std::vector<std::uint8_t> is_explained(usize(mesh.n_faces()));
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            is_explained[f] = explained_[parts_.of_face(f)];
            if (is_explained[f] == 0)
                for (const Index v : mesh.face(f))
                    half_widths.row(surface_.joined != nullptr ? surface_.joined->original_of[v] : v).setZero();
        }
        surface_.copy_to_copies(half_widths);
        return is_explained;
    }

    const MovingSurface& surface_;
    const Points& positions_;
    const Executor& exec_;
    /// Those before copies are joined.
    const SurfaceParts& parts_;
    KeptVolumes volumes_;
    /// Per part: 1 if it moves.
    std::vector<std::uint8_t> explained_;
};

/// Bounds in which what is flat stays flat.
CoordinateBounds with_flat_facets(CoordinateBounds bounds)
{
    for (std::size_t v = 0; v < bounds.flat.size(); ++v)
        for (unsigned axis = 0; axis < 3; ++axis)
            if ((bounds.flat[v] >> axis & 1U) != 0)
                bounds.half_widths(static_cast<Eigen::Index>(v), axis) = 0.0;
    return bounds;
}

/// The same bounds, in which nothing is taken for flat.
CoordinateBounds without_flat_facets(CoordinateBounds bounds)
{
    bounds.flat.clear();
    return bounds;
}

/// Bounds in which no vertex moves further than it may.
CoordinateBounds shortened(CoordinateBounds bounds, const RoundedMotion& motion, const MovingSurface& surface,
                           const Points& positions)
{
    // Vertices without faces may lie anywhere.
    double largest_coordinate = 0.0;
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        if (!surface.neighbours[static_cast<Index>(v)].empty())
            largest_coordinate = std::max(largest_coordinate, positions.row(v).cwiseAbs().maxCoeff());
    // So much shorter that rounding leads no vertex further.
    const double margin = 4.0 * std::numeric_limits<double>::epsilon() * largest_coordinate;
    const auto shorter = [margin](double length) { return std::max((1.0 - 1e-12) * length - margin, 0.0); };
    if (motion.within)
        bounds.furthest = shorter(*motion.within);
    if (motion.within_along_axes) {
        const Point most = motion.within_along_axes->unaryExpr(shorter);
        bounds.half_widths = bounds.half_widths.cwiseMin(most.replicate(bounds.half_widths.rows(), 1));
    }
    return bounds;
}

/// The smooth surface of a mesh in which no coordinate stands for missing data.
/// @param spikes those of the mesh (see find_spikes).
std::optional<SmoothedWithinSteps> smooth_all(const PolygonMesh& mesh, const Topology& topology,
                                              const Points& positions, std::vector<Spike> spikes,
                                              const RoundedMotion& motion, const Executor& exec)
{
    const Points filled = spikes.empty() ? positions : without_spikes(mesh, topology, spikes, positions);
    const Components components = face_components(mesh, topology);
    const std::optional<JoinedCopies> joined =
        motion.joins_copies ? join_copies(mesh, topology, components, filled, exec) : std::nullopt;
    Topology of_joined;
    if (joined) {
        of_joined = make_topology(joined->mesh, exec);
        free_junctions(joined->mesh, of_joined, exec);
    }
    const JoinedCopies* const copies = joined ? &*joined : nullptr;
    const MovingSurface surface(joined ? joined->mesh : mesh, joined ? of_joined : topology, copies, exec);
    const SurfaceParts parts(mesh, topology, components);
    const CoordinateBounds bounds = bounds_for(
        surface, parts, filled, fractions_of_bounds(topology, copies, motion, mesh.n_vertices()), motion, exec);
    if (bounds.kind == CoordinateBounds::Kind::None || (!motion.given_steps && bounds.half_widths.isZero(0.0)))
        return std::nullopt;
    SmoothingInBounds smoothing(mesh, topology, components, parts, surface, filled, exec);
    const bool judges = !motion.given_steps;
    const bool is_shortened = motion.within || motion.within_along_axes;
    // The limits of evidence for faces of voxels were measured with flat facets that move like the rest: held, these
    // hide how little of pyramids and stairs of blocks rounding explains.
    const bool judges_without_flat = judges && bounds.kind == CoordinateBounds::Kind::Any &&
                                     std::ranges::any_of(bounds.flat, [](std::uint8_t bits) { return bits != 0; });
    const CoordinateBounds with_flat = with_flat_facets(bounds);
    std::optional<SmoothedWithinSteps> result;
    // Whether rounding explains what is rough shows in the whole bounds.
    if (judges || !is_shortened) {
        result = smoothing.smooth(judges_without_flat ? without_flat_facets(bounds) : with_flat, judges);
        if (!result)
            return std::nullopt;
    }
    if (judges_without_flat || is_shortened)
        result = smoothing.smooth(is_shortened ? shortened(with_flat, motion, surface, filled) : with_flat, false);
    if (joined)
        result->is_copy = joined->shared_vertices();
    for (const Spike& spike : spikes)
        result->positions.row(spike.vertex) = positions.row(spike.vertex);
    result->spikes = std::move(spikes);
    return result;
}

}  // namespace

std::optional<SmoothedWithinSteps> smooth_rounded(const PolygonMesh& mesh, const Topology& topology,
                                                  const Points& positions, const RoundedMotion& motion,
                                                  const Executor& exec)
{
    std::vector<Spike> spikes = find_spikes(mesh, positions, exec);
    const std::vector<std::uint8_t> is_missing = vertices_without_data(mesh, positions, spikes);
    if (is_missing.empty())
        return smooth_all(mesh, topology, positions, std::move(spikes), motion, exec);
    const KnownSurface known(mesh, topology, is_missing, exec);
    std::optional<SmoothedWithinSteps> result =
        smooth_all(known.mesh, known.topology, positions, find_spikes(known.mesh, positions, exec), motion, exec);
    if (!result)
        return std::nullopt;
    std::ranges::copy_if(spikes, std::back_inserter(result->spikes),
                         [&](const Spike& spike) { return is_missing[spike.vertex] != 0; });
    std::ranges::sort(result->spikes, {}, &Spike::vertex);
    result->is_smoothed = known.of_all_faces(mesh, result->is_smoothed);
    return result;
}

std::string steps_in_words(const Point& steps)
{
    // Steps that are found differ by rounding.
    constexpr double equal = 1e-6;
    if (steps.maxCoeff() - steps.minCoeff() <= equal * steps.maxCoeff())
        return fmt::format("{:.6g} in x, y and z", steps.maxCoeff());
    constexpr std::string_view axes = "xyz";
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
        if (steps[axis] > 0.0)
            text += fmt::format("{}{:.6g} in {}", text.empty() ? "" : ", ", steps[axis],
                                axes[static_cast<std::size_t>(axis)]);
    return text;
}

}  // namespace seamflow
