#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"
#include "solvers/conditions/robin_parameter.h"
#include "solvers/direct/factorisation.h"
#include "solvers/filters/step_filter.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// How the sub-meshes are coloured. Sub-meshes of one colour are independent; the colours solve one after another.
enum class Colouring {
    /// Two colours (red-black) where the sub-mesh adjacency is bipartite, few otherwise. Colour classes are solved in
    /// order of decreasing total curvature Σ‖ΔV⁰‖.
    Greedy,
    /// The colour of a sub-mesh is its label: in a forward sweep sub-mesh 0 solves first, then 1, and so on.
    Label,
};

/// Conditions on the interface Γ between any number of sub-meshes.
enum class Conditions {
    /// The paper's adapted Robin conditions (eqs. 24 and 25 with q = 0).
    AdaptedRobin,
    /// The paper's adapted Ventcell conditions (eqs. 24 and 25); InterfaceOptions::q is required.
    AdaptedVentcell,
    /// The classical Robin conditions (eqs. 20 and 21 with q = 0): every sub-mesh has derivative rows on Γ and its own
    /// copy of Γ. The copies drift apart (StepReport::gap); the result is their mean.
    Robin,
    /// The classical Ventcell conditions (eqs. 20 and 21); InterfaceOptions::q is required.
    Ventcell,
    /// The alternating Schwarz method (eqs. 18 and 19): sub-meshes overlap by InterfaceOptions::overlap layers of
    /// faces.
    Schwarz,
};

/// The time integration scheme.
enum class Scheme {
    /// (I + dt Δ(Vⁿ)) Vⁿ⁺¹ = Vⁿ (paper, eq. 3).
    BackwardEuler,
    /// Vⁿ⁺¹ = (I - dt Δ(Vⁿ)) Vⁿ, undecomposed: options about sub-meshes are ignored. dt must not exceed the square of
    /// the shortest edge; a quarter of it is safe on regular grids. Above that the surface
    /// can become rough instead of smooth; the report then has a remark.
    ExplicitEuler,
};

/// The flow.
enum class FlowEquation {
    /// ∂V/∂t = -Δ(V) V, mean curvature flow.
    MeanCurvature,
    /// The conformalized flow of Kazhdan, Solomon and Ben-Chen (Can Mean-Curvature Flow Be Modified to Be
    /// Non-Singular?, 2012): (M(Vⁿ) + dt K(V⁰)) Vⁿ⁺¹ = M(Vⁿ) Vⁿ. Necks do not pinch; a closed surface
    /// without handles tends to a sphere. K is assembled once. For symmetric Laplacians and backward Euler steps.
    Conformalized,
    /// The heat equation on the first surface, applied to its coordinates: (M(V⁰) + dt K(V⁰)) Vⁿ⁺¹ = M(V⁰) Vⁿ. The
    /// matrix is factorised once: every step after the first is one solution. For symmetric Laplacians and backward
    /// Euler steps that are converged (Approach::Converged), undecomposed, or by conjugate gradients.
    Linear,
};

/// The weights of the edges of a surface, -K_vw.
enum class Weights {
    /// Those of the Laplacian. Cotangents of obtuse angles are below 0.
    OfLaplacian,
    /// At least 0, so that no step of Filter::Diffusion of order 1 leaves the range of its data (the discrete maximum
    /// principle). Where the Laplacian has others, K and M are those of an intrinsic Delaunay triangulation of the
    /// surface (see make_delaunay). For linear flows with Δ_A and Δ_B; the others have no such weights.
    AtLeastZero,
    /// Those of each face alone, too: where Flow::keep_field_edges weighs faces differently.
    AtLeastZeroInFaces,
};

/// The η in p* = ((k_min² + η)(k_max² + η))^¼ (paper, eq. 26).
enum class PRule {
    /// η = 1, the paper's (which makes p* depend on the unit of length).
    Paper,
    /// η = 1 / dt.
    InverseStep,
};

/// How the first sub-mesh to solve at a vertex of Γ takes account of those on the other side.
enum class Transmission {
    /// Derivatives as in the paper, at Vᵏ.
    Derivative,
    /// A prediction of the other side, solved with Γ held at Vᵏ (see engine/accuracy.md).
    Predicted,
};

/// The order in which the colours solve.
enum class Sweep {
    /// Fixed for two sub-meshes and with Conditions::Schwarz, else Alternating.
    Automatic,
    /// The same order in every step, as in the paper.
    Fixed,
    /// First to last in even steps, last to first in odd steps. Not with Conditions::Schwarz, whose overlaps are made
    /// for one order.
    Alternating,
};

/// Correction of the vertices of Γ after each step.
enum class Correction {
    /// Centroid with the adapted conditions, which need it and for which the authors of the paper use it.
    Automatic,
    /// Each vertex moves to the centroid of its edge neighbours, all at once (paper, eq. 28). Not for the classical
    /// conditions, which have several copies of each vertex.
    Centroid,
    None,
};

/// Boundary conditions on the boundary of the whole mesh.
enum class Boundary {
    /// Boundary vertices stay where they are, bit for bit.
    Fixed,
    /// Natural boundary conditions: the equations at the boundary are assembled from the existing faces. The surface
    /// shrinks there by about √dt a step, like a soap film without a frame. Not with Δ_P, whose one-sided rows at a
    /// boundary are unstable. Sub-meshes can share such a boundary only in converged steps, which are then chosen.
    Free,
    /// The boundary alone moves, along the surface: each of its lines becomes a curve that bends less (see
    /// smooth_curve), in which bumps of FlowOptions::radius are half as high, and which neither shrinks nor slides. The
    /// surface follows within a band a few times as wide as the motion. There are no sub-meshes and no equations of the
    /// Laplacian, as with keep_edges; not with denoise and keep_edges.
    Smooth,
};

/// Vertices at junctions: on edges of three faces or more, where sheets of a surface meet.
enum class Junctions {
    /// They move like others: K and M are sums over the faces of all sheets, so that the lines of three sheets tend to
    /// angles of 120°. Sub-meshes can share such lines only in converged steps, which are then chosen. Held instead
    /// with Δ_P, with keep_edges, and where an option asks for sweeps over sub-meshes; a remark says so. Vertices where
    /// merely several fans of faces touch stay held: they are usually a defect.
    Flow,
    /// They stay where they are, and so do all other vertices where the mesh is not manifold.
    Hold,
};

/// Compensation for the shrinking of the surface.
enum class Rescale {
    None,
    /// Scales each component of every result to its area in the input, and moves its centroid to that in the input.
    Area,
    /// The same for the enclosed volume of closed, consistently oriented surfaces.
    Volume,
};

/// The solver of a backward Euler step.
enum class Approach {
    /// The fastest of Decomposed, ConjugateGradients and Undecomposed, by a cost model. It is Decomposed if another
    /// option concerns sub-meshes or sweeps, or if the Laplacian is not symmetric.
    Automatic,
    /// Sub-meshes: Converged with a tolerance, or to a loose one where that pays, otherwise Sweep.
    Decomposed,
    /// One sweep over the colours. Not with a tolerance.
    Sweep,
    /// Sub-meshes that converge to the undecomposed step, to AccuracyOptions::tolerance or a loose one.
    Converged,
    /// Conjugate gradients on the whole mesh, to AccuracyOptions::tolerance or a loose one: no sub-meshes, no
    /// factorisation, and the shortest set-up. For symmetric Laplacians.
    ConjugateGradients,
    /// One factorisation of the whole mesh: exact.
    Undecomposed,
};

/// The cut of the mesh into sub-meshes.
struct CutOptions {
    /// Number of sub-meshes. 1: undecomposed. 0: chosen from the size of the mesh and √dt. Every component of the mesh
    /// has at least one sub-mesh of its own, and no sub-mesh is cut too small; the number used is in FlowReport.
    int subdomains = 0;
    /// A given cut: the sub-mesh of every face (#F entries, each at least 0). Empty: `subdomains` applies. Parts that
    /// are not connected, or pinched at a vertex, are repaired by moving faces.
    std::vector<Index> labels = {};
};

/// Conditions on the interface Γ between sub-meshes in a sweep, and the order in which they solve.
struct InterfaceOptions {
    /// Conditions on Γ.
    Conditions conditions = Conditions::AdaptedRobin;
    /// For Conditions::AdaptedRobin. Predicted stays much closer to the undecomposed flow.
    Transmission transmission = Transmission::Predicted;
    /// Robin parameter p, in 1/length, positive. It implies Transmission::Derivative. Empty: p* of the paper (eq. 27)
    /// for each sub-mesh, by the two rules below; values other than their defaults imply Transmission::Derivative, too.
    std::optional<double> p = {};
    PRule p_rule = PRule::Paper;
    PEdge p_edge = PEdge::Automatic;
    /// Ventcell parameter q of the tangential derivative, dimensionless, not negative. Required with AdaptedVentcell
    /// and Ventcell; not allowed with other conditions.
    std::optional<double> q = {};
    /// Layers of faces by which sub-meshes overlap with Conditions::Schwarz, at least 1: each sub-mesh grows that many
    /// times by the faces that share a vertex with it, into sub-meshes that do not solve before it. Other conditions
    /// ignore it.
    int overlap = 1;
    /// Order of sub-meshes in a step.
    Colouring colouring = Colouring::Greedy;
    /// Direction of the sweep over the colours.
    Sweep sweep = Sweep::Automatic;
    /// Treatment of the interface after a step.
    Correction correction = Correction::Automatic;

    friend bool operator==(const InterfaceOptions&, const InterfaceOptions&) = default;
};

/// Distance of steps to the undecomposed ones, and the largest update of a step.
struct AccuracyOptions {
    /// Steps converge to the undecomposed step, in place of sweeps with InterfaceOptions: to this residual relative to
    /// that of the positions before the step. For symmetric Laplacians it is the residual on Γ, or of all rows with
    /// Approach::ConjugateGradients. Those of Δ_P factorise the whole mesh, exactly. Empty: `approach` decides.
    std::optional<double> tolerance = {};
    /// The solver.
    Approach approach = Approach::Automatic;
    /// Largest number of iterations of a step.
    int converge_iterations = 1000;
    /// Largest displacement of a vertex in one step, in diagonals of the bounding box of the mesh before the first
    /// step; positive. A step that exceeds it ends the flow with the step before. Δ_P, and Δ_A on polygons, can do so
    /// where their equations are indefinite. Infinite: any finite result is accepted.
    double largest_update = 1.0;
};

/// A length in units of the mesh, or a fraction of the diagonal of the box around its faces: {0.01, true} is
/// 1 % of it.
struct LengthOnMesh {
    double value = 0.0;
    bool of_diagonal = false;

    friend bool operator==(const LengthOnMesh&, const LengthOnMesh&) = default;
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
};

/// The lines along which vertices move. What slides along the surface that a step makes is left out.
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
    /// Of any length above 0.
    Point vector = Point::Zero();

    friend bool operator==(const MotionDirection& a, const MotionDirection& b)
    {
        return a.kind == b.kind && a.vector.cwiseEqual(b.vector).all();
    }
};

/// Constraints on the motion of vertices.
struct MotionOptions {
    /// Strengths below this hold a vertex, as 0 does.
    static constexpr double least_strength = 1e-9;

    /// Distance, in units of length, within which boundary vertices count as coincident where two boundary edges can
    /// become one (see weld). Such vertices move as one, but stay separate in the mesh, so that the surface continues
    /// across seams of its texture. Moving copies come to one place; fixed ones stay where they are. 0: coordinates
    /// have to be equal. nullopt disables welding.
    std::optional<double> weld = 0.0;
    /// Boundary conditions.
    Boundary boundary = Boundary::Fixed;
    /// Vertices where sheets meet.
    Junctions junctions = Junctions::Flow;
    /// Vertices that stay where they are, bit for bit; in any order, repetitions are allowed.
    std::vector<Index> fixed_vertices = {};
    /// Edges that keep_edges and denoise keep whatever their angle: pairs of vertices that share an edge of a face.
    /// Faces on the two sides are smoothed independently. With keep_edges alone a vertex between two of these edges
    /// moves along them, at most to their midpoints; all others on them stay.
    std::vector<Edge> feature_edges = {};
    /// Refuses meshes on which the flow is not defined everywhere: those that are not manifold, or on which edges
    /// without length (Δ_F) or faces without area (the others) leave the Laplacian undefined at vertices that should
    /// move. If false, such vertices stay fixed, except at junctions, and a remark gives their number.
    bool strict = false;
    /// w of a screening term that pulls towards the first positions, in 1/length², at least 0:
    /// ∂V/∂t = -ΔV - w (V - V⁰). Features larger than about 1/√w stay, because the flow ends at the solution of
    /// (Δ + w) V = w V⁰. 0: no such term. For symmetric Laplacians and backward Euler steps.
    double attachment = 0.0;
    /// The same with a w for each vertex, #V, in place of `attachment`: soft constraints, beside fixed_vertices. Empty:
    /// `attachment` applies.
    std::vector<double> attachment_weights = {};
    /// The strength of each step at each vertex, #V, from 0 to 1: dt there is the strength times time_step, so that 0
    /// holds a vertex bit for bit, and a mask of 0 and 1 smooths a region alone (see feathered for one without a crease
    /// at its rim). Faces without a moving vertex cost next to nothing. Not for
    /// sweeps. With keep_edges it scales the displacement of each step. Empty: 1 everywhere.
    std::vector<double> strength = {};
    /// Motion along lines alone: after each step the displacement of every vertex is projected on its line, and the
    /// flow continues from there. Not with rescale, nor for the classical conditions.
    MotionDirection direction = {};
    /// Scales the result of each step. The flow itself continues unscaled, and distances to the undecomposed flow are
    /// unscaled; the conformalized flow continues from the scaled result, so that it does not vanish on its way to a
    /// sphere. Every vertex with faces moves: none of them may be fixed.
    Rescale rescale = Rescale::None;
    /// Largest distance of any vertex from its first position, above 0, in units of length. It bounds each result; the
    /// flow itself is not changed. Vertices beyond it are put back to that distance, and their neighbours follow
    /// smoothly. nullopt: no bound.
    std::optional<double> within = {};
    /// Limits of each result, like `within`.
    ComponentLimits limits = {};
};

/// Resources of the machine.
struct ResourceOptions {
    static constexpr int most_threads = 1024;

    /// Number of threads, at most most_threads. 0: those of the calling TBB arena (by default all cores). The result is
    /// the same, bit for bit, for any number.
    int threads = 0;
    /// The number of cores, at least 1, for which an automatic approach is the fastest. The result depends on it, and
    /// on no number of threads.
    int tune_for = 2;
    /// Largest number of bytes of all factorisations at once, at least 1. nullopt: sweeps keep as few factorisations as
    /// keep all threads busy, converged steps keep all. With a limit, converged steps of symmetric Laplacians recompute
    /// the other factorisations when they are needed, and factors of undecided precision count as double precision.
    /// Factors of UMFPACK count by its own estimate. If the limit is too small for a step, a flow whose approach is
    /// automatic takes conjugate gradients, which factorise nothing, where its other options allow it; any other throws
    /// a MemoryLimitError with the necessary number. Otherwise the result does not depend on the limit. It does not
    /// apply to `reference`.
    std::optional<std::size_t> memory_limit = {};
    /// The direct solver of sub-meshes. It changes the result by rounding only. Converged steps of symmetric Laplacians
    /// always use the library's own, which provides their Schur complements.
    Factorisation factorisation = Factorisation::Automatic;
    /// Precision of the factors in converged steps of symmetric Laplacians. Single precision takes half the memory and
    /// little more than half the time; because the residual is in double precision, steps converge to the same
    /// tolerance. With Precision::Single, equations that become indefinite in single precision end the flow.
    Precision precision = Precision::Automatic;
};

/// What a flow reports beside its result.
struct ReportOptions {
    /// Also runs the undecomposed flow, by backward Euler steps whatever the scheme, and reports the distance to it
    /// after each step.
    bool reference = false;
    /// Records which task ran when and in which thread (FlowReport::schedule): 32 bytes per task and step. Steps of
    /// Scheme::ExplicitEuler have no tasks.
    bool record_schedule = false;
    /// Also returns the sub-meshes, each with its own copy of Γ (FlowReport::separated, StepState::separated). Only for
    /// the classical conditions with Scheme::BackwardEuler: with others the copies are equal.
    bool keep_gaps = false;
    /// Measures mean curvature and displacements after each step, which takes a fifth to two thirds of its time. If
    /// false, they are 0 in the report.
    bool measures = true;
};

/// All options of a flow: `{.time_step = 0.05, .steps = 5, .cut = {.subdomains = 8}}`.
struct FlowOptions {
    static constexpr int most_steps = 1'000'000'000;

    /// The discrete Laplacian.
    Laplacian laplacian = Laplacian::Fujiwara;
    /// The flow: whether K and M of the Laplacian follow the surface.
    FlowEquation flow = FlowEquation::MeanCurvature;
    /// A filter other than Diffusion of order 1 takes several solutions a step, with one factorisation: 8 and 11 for
    /// Diffusion of order 2 and 3, to a hundredth, m for LowPass of order m. For symmetric Laplacians and backward
    /// Euler steps of any solver; sweeps need predicted transmission, and keep all factors.
    Filter filter = Filter::Diffusion;
    /// That of the filter (see Filter). Empty: 1 for Diffusion, 2 for LowPass. Diffusion has 1 to 3, LowPass 2 to 8.
    std::optional<int> order = {};
    /// dt of one step, in length²; one step smooths over a distance of about √dt. Must be positive and finite, or 0 if
    /// `radius` gives the amount.
    double time_step = 0.0;
    /// The amount of all steps together, in place of time_step: bumps of this radius lose half their height, smaller
    /// ones more (see smoothed_radius; with uniform weights those of uneven meshes up to a tenth less). Must be
    /// positive and finite. FlowReport::time_step has the resulting dt.
    std::optional<LengthOnMesh> radius = {};
    /// h of Laplacian::Uniform: the edge length, in length, for which dt and radii hold. 0: the mean edge length of the
    /// given mesh. Must be finite, and not negative.
    double uniform_edge = 0.0;
    /// Whether data that diffuse stay in their range. Ranks do not share steps with weights other than the Laplacian's.
    Weights weights = Weights::OfLaplacian;
    /// Number of steps, from 0 (which leaves the mesh as it is) to most_steps.
    int steps = 1;
    /// The time integration scheme.
    Scheme scheme = Scheme::BackwardEuler;
    /// Keeps edges at which the normals of faces differ by more than this angle, in degrees, above 0 and below 180, and
    /// corners where such edges meet; 20 to 40 suit most meshes. Smaller angles are smoothed. In each step, face
    /// normals diffuse by dt, but not across edges, and vertices move to fit them.
    /// dt has its usual meaning; because edges do not suffer, eight to thirty squared mean edge lengths suit one step
    /// of parts of planes with noise. Clean round parts bend by it: with `denoise` the noise of each place is the
    /// amount. Further steps start from the resulting surface. Fixed vertices stay, and a free boundary does not
    /// shrink. There are no sub-meshes, no equations of the Laplacian (which still gives the reported mean curvatures),
    /// and no undecomposed flow to compare with: options about these are refused. nullopt: mean curvature flow.
    std::optional<double> keep_edges = {};
    /// Removes noise in place of a flow: each step estimates the true normal of each face and how large the noise is
    /// there, and moves vertices to fit; along the normals, unless a face would fold. Edges,
    /// round parts and details stay, and where there is no noise, vertices stay bit for bit. No amount is needed:
    /// time_step is ignored. One step is enough; further ones treat what is left as noise. As with keep_edges there are
    /// no sub-meshes and no equations of the Laplacian. With both, edges sharper than the angle stay where the noise is
    /// small, in place of those above 30 degrees.
    bool denoise = false;
    CutOptions cut = {};
    InterfaceOptions interface = {};
    AccuracyOptions accuracy = {};
    MotionOptions motion = {};
    ResourceOptions resources = {};
    ReportOptions report = {};

    /// The paper's method, generalised to many sub-meshes and nothing else: a fixed sweep and derivatives at Vᵏ. It
    /// does not change with the defaults.
    static FlowOptions plain();

    /// Those without an amount: `denoise`, also of boundaries, and no component loses more of its volume than
    /// ComponentLimits::most_volume_change.
    static FlowOptions denoising();
};

/// Whether every sub-mesh keeps its own copy of Γ.
bool is_classical(Conditions conditions);

/// Whether the conditions have a tangential derivative, and with it the Ventcell parameter q.
bool has_tangential_derivative(Conditions conditions);

/// Whether each step is (M + dt K) Vᵏ⁺¹ = M Vᵏ with M and K of Vᵏ, and nothing else.
bool is_plain_flow(const FlowOptions& options);

/// The Laplacian with its scale.
ScaledLaplacian laplacian_of(const FlowOptions& options);

/// The filter of each step, with the tolerance of the steps.
StepFilter filter_of(const FlowOptions& options);

/// Whether a sweep uses predictions of the other side of Γ.
bool predicts(const FlowOptions& options);

/// Whether steps move the boundary alone, as curves.
bool smooths_rims(const FlowOptions& options);

/// Whether steps take the whole mesh in place of a flow: with keep_edges or denoise, which smooth the normals of faces,
/// or where they move the boundary alone.
bool smooths_normals(const FlowOptions& options);

/// Whether there is a screening term.
bool attaches(const MotionOptions& motion);

/// Whether steps are taken without sub-meshes.
bool takes_whole_mesh(Approach approach);

}  // namespace seamflow
