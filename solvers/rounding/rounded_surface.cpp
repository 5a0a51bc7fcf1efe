#include "solvers/rounding/rounded_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/connected_components.h"
#include "partition/metrics/edge_measures.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "solvers/rounding/joined_copies.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/missing_data.h"
#include "solvers/rounding/normals_in_boxes.h"
#include "solvers/rounding/surface_parts.h"
#include "solvers/rounding/uncrossed_faces.h"

namespace seamflow {

namespace {

/// When rounding explains what is rough: if the fraction of bending that is left and the fraction of vertices near
/// their bounds, times a weight, add up to at most a limit; or if few vertices are near bounds, and less is left than a
/// limit of its own.
struct Evidence {
    /// A vertex is near a bound if it has moved by this fraction of its half-width.
    double near;
    double weight;
    double most;
    double few;
    double most_with_few;

    /// @param bending the fraction that is left. @param fraction of the vertices that are near a bound. Where true
    /// places lie anywhere between the bounds, as those of heights do, 1 - near of them are.
    [[nodiscard]] bool explains(double bending, double fraction) const
    {
        return bending + weight * std::max(fraction - (1.0 - near), 0.0) <= most ||
               (fraction <= few && bending <= most_with_few);
    }
};

/// The comments give measured sums as [digitised shapes; shapes made of blocks]. Digitised shapes (balls, tori, tubes,
/// boxes, plates, egg crates, terrains) are to be smoothed. Shapes made of blocks (pyramids of steps, studs, ribs,
/// pockets) are to stay. Stairs that a digitised plane could be as well have sums of the first kind.
Evidence evidence_for(const CoordinateBounds& bounds)
{
    constexpr double fine = 0.5;
    switch (bounds.kind) {
    case CoordinateBounds::Kind::Heights:
        // [0.02 to 0.9; 0.93 to 3.3, and noise of 0.3 steps on steep ground 0.95]
        return {.near = 0.9, .weight = 3.2, .most = 0.9, .few = 0.0, .most_with_few = 0.0};
    case CoordinateBounds::Kind::MarchingCubes:
        // [0.15 to 0.79, one plate in thick slices 1.27; 0.83 to 1.3]. Thin vessels keep .8 to .96 of their bending,
        // but less than 0.035 of their vertices are near bounds; of shapes of blocks 0.056 are.
        return {.near = 0.98, .weight = 2.0, .most = 0.81, .few = 0.04, .most_with_few = 0.97};
    default:
        // Steps much shorter than edges make no blocks: what bends less within them was rounded, or has noise, of which
        // more vertices are near bounds. Of boxes, balls, gears and threads [0.08 to 0.82 is left, 0.31 to 0.53 near;
        // clean 0.999 and more is left, with noise of half a step 0.57 and more near]
        if (bounds.steps.maxCoeff() < fine * bounds.edge)
            return {.near = 0.9, .weight = 0.0, .most = 0.0, .few = 0.56, .most_with_few = 0.9};
        // [0.09 to 0.364; 0.37 to 1.3]
        return {.near = 0.9, .weight = 0.6, .most = 0.3675, .few = 0.0, .most_with_few = 0.0};
    }
}

/// A fairing ends when no coordinate moves by more than this many steps in an iteration.
constexpr double last_motion = 0.002;
constexpr int most_iterations = 400;

/// Whether a vertex has moved by at least the fraction `near` of its half-width, in a direction in which bounds are
/// widest, in steps; nothing for vertices with less than the whole bounds.
std::optional<bool> is_near_bound(const Boxes& boxes, const Point& steps, double near, const Points& positions, Index v)
{
    if (!boxes.flat.empty() && boxes.flat[v] != 0)
        return std::nullopt;
    const Point motion = (positions.row(v) - boxes.middles.row(v)).cwiseAbs();
    const Point half_width = boxes.half_widths.row(v);
    const Point in_steps = (steps.array() > 0.0).select(half_width.array() / steps.array(), 0.0);
    // Within a part of the bounds, which a strength leaves, more vertices are near them.
    constexpr double nearly_half = 0.49;
    if (!(in_steps.maxCoeff() > nearly_half))
        return std::nullopt;
    return (in_steps.array() >= near * in_steps.maxCoeff() && motion.array() >= near * half_width.array()).any();
}

/// Per part: the fraction of the vertices with whole bounds that are near one; 1 without any: nothing shows that they
/// suffice.
std::vector<double> fractions_near_bounds(const SurfaceParts& parts, const Boxes& boxes, const CoordinateBounds& bounds,
                                          const Points& positions)
{
    std::vector<double> near(usize(parts.count()), 0.0);
    std::vector<double> all(usize(parts.count()), 0.0);
    const double fraction = evidence_for(bounds).near;
    for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v)
        if (const Index part = parts.of_vertex(v); part >= 0)
            if (const auto is_near = is_near_bound(boxes, bounds.steps, fraction, positions, v)) {
                all[part] += 1.0;
                near[part] += *is_near ? 1.0 : 0.0;
            }
    for (std::size_t part = 0; part < all.size(); ++part)
        near[part] = all[part] > 0.0 ? near[part] / all[part] : 1.0;
    return near;
}

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

/// Takes the positions of the vertices of some parts.
void take(const SurfaceParts& parts, const std::vector<std::uint8_t>& taken, const Points& from, Points& positions,
          const Executor& exec)
{
    for_each(exec, static_cast<Index>(positions.rows()), [&](Index v) {
        if (const Index part = parts.of_vertex(v); part >= 0 && taken[part] != 0)
            positions.row(v) = from.row(v);
    });
}

/// Smooths normals in both ways, and takes for each part the surface that bends less.
/// @param volumes those that are kept. @param positions #V by 3: in the boxes; replaced.
void smooth_normals(const MovingSurface& surface, const KeptVolumes& volumes, const Boxes& boxes, Points& positions,
                    const Executor& exec)
{
    const Components components = face_components(surface.mesh, surface.topology);
    const SurfaceParts parts(surface.mesh, surface.topology, components);
    NormalsInBoxes normals(surface.mesh, surface.topology, parts, volumes, boxes, exec);
    Points with_edges = positions;
    const std::vector<double> bending = normals.smooth(NormalNeighbours::All, positions);
    const std::vector<double> of_edges = normals.smooth(NormalNeighbours::SameSideOfEdge, with_edges, bending);
    std::vector<std::uint8_t> taken(bending.size(), 0);
    for (std::size_t part = 0; part < bending.size(); ++part)
        taken[part] = NormalsInBoxes::bends_no_less(of_edges[part], bending[part]) ? 0 : 1;
    take(parts, taken, with_edges, positions, exec);
}

/// Per part: 1 if rounding explains its roughness.
std::vector<std::uint8_t> explained_parts(const SurfaceParts& parts, const CoordinateBounds& bounds, const Boxes& boxes,
                                          const Points& positions, const Executor& exec)
{
    const std::vector<double> before = parts.bending(boxes, boxes.middles, exec);
    const std::vector<double> after = parts.bending(boxes, positions, exec);
    const std::vector<double> near = fractions_near_bounds(parts, boxes, bounds, positions);
    const Evidence evidence = evidence_for(bounds);
    std::vector<std::uint8_t> explained(before.size());
    for (std::size_t part = 0; part < before.size(); ++part)
        explained[part] = before[part] > 0.0 && evidence.explains(after[part] / before[part], near[part]) ? 1 : 0;
    return explained;
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
        smooth_normals(surface_, volumes_, boxes, result.positions, exec_);
        surface_.copy_to_copies(result.positions);
        if (judges) {
            explained_ = explained_parts(parts_, bounds, boxes, result.positions, exec_);
            if (std::ranges::find(explained_, 1) == explained_.end())
                return std::nullopt;
        }
        result.is_smoothed = hold_others(bounds.half_widths);
        for_each(exec_, static_cast<Index>(positions_.rows()),
                 [&](Index v) { result.positions.row(v) = boxes.nearest(v, result.positions.row(v)); });
        uncross_faces(surface_.mesh, surface_.topology, fair, boxes, result.positions, exec_);
        surface_.copy_to_copies(result.positions);
        return result;
    }

  private:
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
CoordinateBounds shortened(CoordinateBounds bounds, const RoundedMotion& motion, double largest_coordinate)
{
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
std::optional<SmoothedWithinSteps> smooth_all(const PolygonMesh& mesh, const Topology& topology,
                                              const Points& positions, const RoundedMotion& motion,
                                              const Executor& exec)
{
    std::vector<Spike> spikes = find_spikes(mesh, positions, exec);
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
        result = smoothing.smooth(is_shortened ? shortened(with_flat, motion, filled.cwiseAbs().maxCoeff()) : with_flat,
                                  false);
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
    const std::vector<Spike> spikes = find_spikes(mesh, positions, exec);
    const std::vector<std::uint8_t> is_missing = vertices_without_data(mesh, positions, spikes);
    if (is_missing.empty())
        return smooth_all(mesh, topology, positions, motion, exec);
    PolygonMesh known;
    known.vertices = mesh.vertices;
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (std::ranges::none_of(mesh.face(f), [&](Index v) { return is_missing[v] != 0; })) {
            known.add_face(mesh.face(f));
            faces.push_back(f);
        }
    Topology of_known = make_topology(known, exec);
    if (!topology.junctions.empty())
        free_junctions(known, of_known, exec);
    of_known.fixed = topology.fixed;
    std::optional<SmoothedWithinSteps> result = smooth_all(known, of_known, positions, motion, exec);
    if (!result)
        return std::nullopt;
    for (const Spike& spike : spikes)
        if (is_missing[spike.vertex] != 0)
            result->spikes.push_back(spike);
    std::ranges::sort(result->spikes, {}, &Spike::vertex);
    // Faces beside missing data go with those around them.
    const std::vector<std::uint8_t> of_faces = std::exchange(result->is_smoothed, {});
    std::vector<std::uint8_t> is_held(usize(mesh.n_vertices()), 0);
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (of_faces[i] == 0)
            for (const Index v : mesh.face(faces[i]))
                is_held[v] = 1;
    result->is_smoothed.resize(usize(mesh.n_faces()));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        result->is_smoothed[f] = std::ranges::any_of(mesh.face(f), [&](Index v) { return is_held[v] != 0; }) ? 0 : 1;
    for (std::size_t i = 0; i < faces.size(); ++i)
        result->is_smoothed[faces[i]] = of_faces[i];
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
