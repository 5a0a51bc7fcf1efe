#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "partition/polygon_mesh.h"

/// Constraints on the vertices of a surface that moves, by a flow or by denoise().
namespace seamflow {

/// The largest numbers of steps and of threads.
inline constexpr int most_steps = 1'000'000'000;
inline constexpr int most_threads = 1024;

/// A length in units of the mesh, `0.5`; or a fraction of the diagonal of the box around its faces: `{0.01, true}` is
/// 1 % of it.
struct LengthOnMesh {
    constexpr LengthOnMesh(double in_units_or_diagonals = 0.0, bool is_of_diagonal = false)
        : value(in_units_or_diagonals)
        , of_diagonal(is_of_diagonal)
    {
    }

    double value;
    bool of_diagonal;

    friend bool operator==(const LengthOnMesh&, const LengthOnMesh&) = default;
};

/// The largest distance of a vertex from where it was: one in all directions, `0.5`, or one along each of x, y and z,
/// `{1.0, 1.0, 0.2}`, so that it stays in a box.
struct MotionBound {
    constexpr MotionBound(LengthOnMesh distance = {})
        : lengths{distance, distance, distance}
    {
    }
    constexpr MotionBound(double distance)
        : MotionBound(LengthOnMesh(distance))
    {
    }
    constexpr MotionBound(LengthOnMesh x, LengthOnMesh y, LengthOnMesh z)
        : lengths{x, y, z}
        , along_axes(true)
    {
    }

    /// Equal if they are not along axes.
    std::array<LengthOnMesh, 3> lengths;
    bool along_axes = false;

    friend bool operator==(const MotionBound&, const MotionBound&) = default;
};

/// How much is smoothed, in one of three ways.
struct SmoothingAmount {
    /// dt of one step, in length²; one step smooths over a distance of about √dt. Must be positive and finite, or 0 if
    /// another field gives the amount.
    double time_step = 0.0;
    /// dt of one step, in squared mean edge lengths. Must be positive and finite.
    std::optional<double> time_step_edges = {};
    /// The amount of all steps together: bumps of this radius lose half their height, smaller ones more (see
    /// smoothed_radius). Must be positive and finite.
    std::optional<LengthOnMesh> radius = {};
};

/// Boundary conditions on the boundary of the whole mesh.
enum class Boundary {
    /// Boundary vertices stay where they are, bit for bit.
    Fixed,
    /// Natural boundary conditions: the equations at the boundary are assembled from the existing faces. The surface
    /// shrinks there by about √dt a step, like a soap film without a frame. Not with Δ_P (Laplacian::PtackovaVelho),
    /// whose one-sided rows at a boundary are unstable. Sub-meshes can share such a boundary only in converged steps,
    /// which are then chosen.
    Free,
};

/// Vertices at junctions: on edges of three faces or more, where sheets of a surface meet.
enum class Junctions {
    /// They move like others: K and M are sums over the faces of all sheets, so that the lines of three sheets tend to
    /// angles of 120°. Sub-meshes can share such lines only in converged steps, which are then chosen. The vertices are
    /// held instead with Δ_P, with SmoothBetweenEdges, and if an option asks for sweeps over sub-meshes; a remark says
    /// so. Vertices where merely several fans of faces touch stay held: they are usually a defect.
    Flow,
    /// They stay where they are, and so do all other vertices where the mesh is not manifold.
    Hold,
};

/// Compensation for the shrinking of the surface.
enum class Rescale {
    None,
    /// Scales each component of every result to its area in the input, and moves its centroid to that in the input. Not
    /// where the volume is limited (see ComponentLimits), as where a run chooses how much to smooth: there noise has a
    /// part of the area, and a remark says that it was not restored.
    Area,
    /// Scales each component of every result to its enclosed volume in the input, and moves its centroid to that in the
    /// input. For closed, consistently oriented surfaces.
    Volume,
};

/// Limits on the change of each connected component of a mesh. If a component would exceed one, its displacement is
/// scaled down, or set to zero if less than a tenth of it would be left. For flows that choose their own amount.
struct ComponentLimits {
    /// The limit of volume where a run chooses how much to smooth.
    static constexpr double most_volume_change = 0.02;

    /// Change of the enclosed volume, as a fraction of it; for closed, consistently oriented components.
    double volume = std::numeric_limits<double>::infinity();
    /// Root mean square of the displacements along the normals, over the component, in length.
    double move = std::numeric_limits<double>::infinity();
    /// Displacement of a vertex along the surface, in length: beyond it the vertex moves along the normal only. At
    /// junctions, which have no normal, it bounds the whole displacement.
    double slide = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool exist() const { return std::isfinite(volume) || std::isfinite(move) || std::isfinite(slide); }

    friend bool operator==(const ComponentLimits&, const ComponentLimits&) = default;
};

/// The lines along which vertices move. Sliding along the surface that a step makes is left out.
struct MotionDirection {
    enum class Kind {
        /// Vertices move freely.
        Any,
        /// Along `vector`, to where the line through the vertex meets the surface that the step makes. Coordinates that
        /// it does not have stay bit for bit, as x and y of a terrain with (0, 0, 1).
        Vector,
        /// Along the normal that each vertex has after the step: parameters and textures hardly slide.
        Normal,
    };
    Kind kind = Kind::Any;
    /// For Kind::Vector: a vector of any length above 0.
    Point vector = Point::Zero();

    /// Whether vertices move along lines that are not parallel to x, y or z.
    [[nodiscard]] bool is_oblique() const
    {
        return kind == Kind::Normal || (kind == Kind::Vector && (vector.array() != 0.0).count() > 1);
    }

    friend bool operator==(const MotionDirection& a, const MotionDirection& b)
    {
        return a.kind == b.kind && a.vector.cwiseEqual(b.vector).all();
    }
};

/// Constraints on the motion of vertices.
struct MotionOptions {
    /// Strengths below this hold a vertex, as 0 does.
    static constexpr double least_strength = 1e-9;

    /// Distance within which boundary vertices count as coincident where two boundary edges can become one (see weld).
    /// Such vertices move as one, but stay separate in the mesh, so that the surface continues across seams of its
    /// texture. Moving copies come to one place; fixed ones stay where they are. 0: coordinates have to be equal.
    /// nullopt disables welding.
    std::optional<LengthOnMesh> weld = 0.0;
    /// Boundary conditions.
    Boundary boundary = Boundary::Fixed;
    /// Vertices where sheets meet.
    Junctions junctions = Junctions::Flow;
    /// Vertices that stay where they are, bit for bit; in any order, repetitions are allowed.
    std::vector<Index> fixed_vertices = {};
    /// Edges that denoise() keeps whatever their angle: pairs of vertices that share an edge of a face. Faces on the
    /// two sides are smoothed independently. With SmoothBetweenEdges a vertex between two of these edges moves along
    /// them, at most to their midpoints; all other vertices on the edges stay.
    std::vector<Edge> feature_edges = {};
    /// Refuses meshes on which the flow is not defined everywhere: those that are not manifold, or on which edges
    /// without length (Fujiwara) or faces without area (other Laplacians) leave the Laplacian undefined at vertices
    /// that should move. If false, such vertices stay fixed, except at junctions, and a remark gives their number.
    bool strict = false;
    /// w of a screening term that pulls towards the first positions, in 1/length², at least 0:
    /// ∂V/∂t = -ΔV - w (V - V⁰). Features larger than about 1/√w stay, because the flow ends at the solution of
    /// (Δ + w) V = w V⁰. 0: no such term. For symmetric Laplacians and backward Euler steps.
    double attachment = 0.0;
    /// R in place of w = 1/R²: features larger than about R stay. Positive and finite.
    std::optional<LengthOnMesh> attachment_radius = {};
    /// #V: w of the screening term for each vertex, in place of `attachment`: soft constraints, beside fixed_vertices.
    /// Empty: `attachment` applies.
    std::vector<double> attachment_weights = {};
    /// The strength of each step at each vertex, #V, from 0 to 1: dt there is the strength times time_step, so that 0
    /// holds a vertex bit for bit, and a mask of 0 and 1 smooths a region alone. Faces without a moving vertex cost
    /// next to nothing. Not for sweeps. In denoise() it scales the displacement of each step. Empty: 1 everywhere.
    std::vector<double> strength = {};
    /// Lets the strength rise from 0 at the rim of its region over this distance, so that no crease appears there (see
    /// feathered). The boundary of the surface is no rim. Positive and finite; nullopt: it does not.
    std::optional<LengthOnMesh> feather = {};
    /// Motion along lines alone: after each step the displacement of every vertex is projected on its line, and the
    /// flow continues from there. Not with rescale, nor for the classical conditions.
    MotionDirection direction = {};
    /// Scales the result of each step. The flow itself continues unscaled, and distances to the undecomposed flow are
    /// unscaled; the conformalized flow continues from the scaled result, so that it does not vanish on its way to a
    /// sphere. Every vertex with faces moves: none of them may be fixed.
    Rescale rescale = Rescale::None;
    /// Largest distance of any vertex from its first position, above 0. It bounds each result; the flow itself is not
    /// changed. Vertices beyond it are put back to that distance, and their neighbours follow smoothly. Rounded
    /// coordinates (see RemoveNoise::rounding) get the smoothest surface within it and half a step. nullopt: no bound.
    std::optional<MotionBound> within = {};
    /// Limits of each result, like `within`.
    ComponentLimits limits = {};
};

/// Whether there is a screening term.
inline bool attaches(const MotionOptions& motion)
{
    return motion.attachment > 0.0 || motion.attachment_radius || !motion.attachment_weights.empty();
}

}  // namespace seamflow
