#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "partition/polygon_mesh.h"
#include "solvers/conditions/robin_parameter.h"
#include "solvers/direct/factorisation.h"
#include "solvers/filters/step_filter.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// How the sub-meshes are coloured. Sub-meshes of one colour are independent; colours are solved in turn.
enum class Colouring {
    /// Two colours (red-black) where the sub-mesh adjacency is bipartite, few otherwise. Colour classes are solved in
    /// order of decreasing total curvature Σ‖ΔV⁰‖.
    Greedy,
    /// The colour of a sub-mesh is its label: in a forward sweep sub-mesh 0 solves first, then 1, and so on.
    Label,
};

/// Which conditions hold on the interface Γ between sub-meshes, of which there may be any number.
enum class Conditions {
    /// The paper's adapted Robin conditions (eqs. 24 and 25 with q = 0).
    AdaptedRobin,
    /// The paper's adapted Ventcell conditions (eqs. 24 and 25); InterfaceOptions::q is required.
    AdaptedVentcell,
    /// The classical Robin conditions (eqs. 20 and 21 with q = 0): every sub-mesh has derivative rows on Γ and a
    /// copy of Γ of its own, which drift apart (StepReport::gap). The result has the mean of the copies.
    Robin,
    /// The classical Ventcell conditions (eqs. 20 and 21); InterfaceOptions::q is required.
    Ventcell,
    /// The alternating Schwarz method (eqs. 18 and 19): sub-meshes overlap by InterfaceOptions::overlap layers of
    /// faces.
    Schwarz,
};

/// How a step is taken.
enum class Scheme {
    /// (I + dt Δ(Vⁿ)) Vⁿ⁺¹ = Vⁿ (paper, eq. 3).
    BackwardEuler,
    /// Vⁿ⁺¹ = (I - dt Δ(Vⁿ)) Vⁿ, undecomposed: all options about sub-meshes are ignored. dt must be at most the square
    /// of the shortest edge (see largest_explicit_step); a quarter of it is safe on regular grids. Beyond that the
    /// surface can become rough instead of smooth; a remark of the report says so.
    ExplicitEuler,
};

/// Which flow is taken.
enum class FlowEquation {
    /// ∂V/∂t = -Δ(V) V, mean curvature flow.
    MeanCurvature,
    /// The conformalized flow of Kazhdan, Solomon and Ben-Chen (Can Mean-Curvature Flow Be Modified to Be
    /// Non-Singular?, 2012): (M(Vⁿ) + dt K(V⁰)) Vⁿ⁺¹ = M(Vⁿ) Vⁿ. Necks do not pinch; a closed surface
    /// without handles goes to a sphere. K is assembled once. For symmetric Laplacians and backward Euler steps.
    Conformalized,
};

/// Which η stands in p* = ((k_min² + η)(k_max² + η))^¼ (paper, eq. 26).
enum class PRule {
    /// η = 1, the paper's (which makes p* depend on the unit of length).
    Paper,
    /// η = 1 / dt.
    InverseStep,
};

/// How the first sub-mesh to solve at a vertex of Γ learns of the sub-meshes on the other side.
enum class Transmission {
    /// By the derivatives of the paper, at Vᵏ.
    Derivative,
    /// By a prediction of the other side, solved with Γ held at Vᵏ (see engine/accuracy.md).
    Predicted,
};

/// In which order the colours are solved.
enum class Sweep {
    /// Fixed for two sub-meshes and with Conditions::Schwarz, else Alternating.
    Automatic,
    /// The same order in every step, as in the paper.
    Fixed,
    /// First to last in even steps, last to first in odd steps. Not with Conditions::Schwarz, whose overlaps are made
    /// for one order.
    Alternating,
};

/// What happens to the vertices of the interface after each step.
enum class Correction {
    /// Centroid with the adapted conditions, which need it; as the paper's authors do.
    Automatic,
    /// Each moves to the centroid of its edge neighbours, all at once (paper, eq. 28). Not with the classical
    /// conditions, which have several copies of each.
    Centroid,
    /// Nothing.
    None,
};

/// What becomes of the boundary of the whole mesh.
enum class Boundary {
    /// It stays where it is, bit for bit.
    Fixed,
    /// It moves, too, under natural conditions: its equations are assembled from the faces that are there. The surface
    /// draws in its rims by about √dt a step, as a soap film without a frame does. Not with Δ_P, whose rows at a
    /// boundary are one-sided and grow what they should smooth. Sub-meshes can share such a boundary only in converged
    /// steps, which are then chosen.
    Free,
};

/// What is done about the shrinking of the surface.
enum class Rescale {
    None,
    /// Every result is scaled to the area of the input, its centroid moved back to that of the input.
    Area,
    /// The same for the enclosed volume; for closed surfaces with faces oriented alike.
    Volume,
};

/// How a backward Euler step is taken.
enum class Approach {
    /// Whatever is fastest by a model of their costs (see choose_approach): Decomposed, ConjugateGradients or
    /// Undecomposed. Decomposed where another option is about sub-meshes or sweeps, or the Laplacian is not symmetric.
    Automatic,
    /// In sub-meshes. Converged where a tolerance is asked for, or to a loose one where that is worth it (see
    /// choose_tolerance); else a sweep.
    Decomposed,
    /// One sweep over the colours, where no tolerance is asked for.
    Sweep,
    /// Converged sub-mesh by sub-mesh, to AccuracyOptions::tolerance or a loose one.
    Converged,
    /// The whole mesh by conjugate gradients, to AccuracyOptions::tolerance or a loose one: no sub-meshes, no
    /// factorisation, and of all ways the least set-up. For Δ_F, Δ_A and Δ_B.
    ConjugateGradients,
    /// The whole mesh by one factorisation: exactly.
    Undecomposed,
};

/// Which sub-meshes there are.
struct CutOptions {
    /// Number of sub-meshes. 1: undecomposed. 0: chosen, if there are any, from the size of the mesh and of √dt. Every
    /// component of the mesh has at least one sub-mesh of its own, and no sub-mesh is cut too small, so the number used
    /// (see FlowReport) can differ.
    int subdomains = 0;
    /// A given cut: the sub-mesh of every face (#F entries, each at least 0), used instead of `subdomains` where not
    /// empty. Parts that are not connected, or pinched at a vertex, are repaired by moving faces.
    std::vector<Index> labels = {};
};

/// What holds on the interface Γ between sub-meshes in a sweep, and in which order they solve.
struct InterfaceOptions {
    /// What holds between sub-meshes.
    Conditions conditions = Conditions::AdaptedRobin;
    /// How sub-meshes learn of each other with Conditions::AdaptedRobin. Predicted stays much closer to the
    /// undecomposed flow.
    Transmission transmission = Transmission::Predicted;
    /// Robin parameter p, in 1/length, positive, for Transmission::Derivative, which it implies. Empty: p* of the paper
    /// (eq. 27) for each sub-mesh, by the two rules that follow, which imply it too where they are not the default.
    std::optional<double> p = {};
    PRule p_rule = PRule::Paper;
    PEdge p_edge = PEdge::Automatic;
    /// Ventcell parameter q of the tangential derivative, without dimension, not negative; required with
    /// AdaptedVentcell and Ventcell, and only there.
    std::optional<double> q = {};
    /// Layers of faces by which sub-meshes overlap with Conditions::Schwarz, at least 1: each grows that often by the
    /// faces that share a vertex with it, into sub-meshes that do not solve before it. Of no use with other conditions.
    int overlap = 1;
    /// Order of sub-meshes in a step.
    Colouring colouring = Colouring::Greedy;
    /// Direction of the sweep over the colours.
    Sweep sweep = Sweep::Automatic;
    /// Treatment of the interface after a step.
    Correction correction = Correction::Automatic;

    friend bool operator==(const InterfaceOptions&, const InterfaceOptions&) = default;
};

/// How near steps come to the undecomposed ones, and when a flow is given up.
struct AccuracyOptions {
    /// Asks for the undecomposed step itself, in place of what InterfaceOptions says: to this residual, relative to
    /// that of the positions before the step. For symmetric Laplacians it is the residual on Γ, or of all rows with
    /// Approach::ConjugateGradients. For Δ_P it is the distance
    /// between the positions that overlapping sub-meshes take from each other and those that they find. Where the
    /// equations of Δ_P are indefinite (it grows spikes then, undecomposed too), there are many iterations, fewer with
    /// fewer sub-meshes. Empty: `approach` says.
    std::optional<double> tolerance = {};
    /// How steps are taken.
    Approach approach = Approach::Automatic;
    /// Most iterations of a step to reach the tolerance.
    int converge_iterations = 1000;
    /// How far a step may move a vertex at most, in diagonals of the bounding box of the mesh before the first step;
    /// positive. A step that moves one further ends the flow with the step before; Δ_P, and Δ_A on polygons, can do so
    /// where their equations are indefinite. Infinite: any finite result is accepted.
    double largest_update = 1.0;
};

/// A length in units of the mesh, or as a part of the diagonal of the bounding box of its vertices: {0.01, true} is 1 %
/// of it.
struct LengthOnMesh {
    double value = 0.0;
    bool of_diagonal = false;
};

/// What each connected component of a mesh may lose; one that would lose more has its displacement, and so its loss,
/// scaled down, to nothing where less than a tenth of it would be left. For flows that choose their amount by
/// themselves.
struct ComponentLimits {
    /// Of the volume that it encloses, in parts of it; of closed components whose faces are oriented alike.
    double volume = std::numeric_limits<double>::infinity();
    /// How far vertices may move along the normals, as root mean square over the component, in length.
    double move = std::numeric_limits<double>::infinity();
    /// How far a vertex may move along the surface, in length: beyond that it is moved along the normal alone.
    double slide = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool exist() const { return std::isfinite(volume) || std::isfinite(move) || std::isfinite(slide); }
};

/// Which vertices move, and where to.
struct MotionOptions {
    /// Within which distance, in units of length, vertices on the boundary count as at equal places, where two edges of
    /// the boundary can become one (see weld): there they move as one, and stay separate vertices. So the surface goes
    /// on across seams of its texture. What moves comes to one place, what is fixed stays where it is. 0: coordinates
    /// have to be equal. Empty: never. Distributed flows do so never.
    std::optional<double> weld = 0.0;
    /// Whether the boundary of the mesh moves.
    Boundary boundary = Boundary::Fixed;
    /// Vertices that stay where they are, bit for bit, wherever they lie; in any order, repetitions are allowed.
    std::vector<Index> fixed_vertices = {};
    /// Edges that keep_edges keeps, however little they bend: pairs of vertices that share an edge of a face. Faces on
    /// both sides of them know nothing of each other there. A vertex between two of them moves along the line that
    /// they make, as far as the middles of both, and the vertices at ends of lines and where more of them meet stay.
    std::vector<Edge> feature_edges = {};
    /// Refuse meshes on which the flow is not defined everywhere: those that are not manifold, or on which edges
    /// without length (Δ_F) or faces without area (the others) leave the Laplacian undefined at vertices that should
    /// move. Without it such vertices are held fixed, and a remark says how many.
    bool strict = false;
    /// w of an attachment to the first positions, in 1/length², at least 0: ∂V/∂t = -ΔV - w (V - V⁰). What is larger
    /// than about 1/√w stays, as the flow ends at the solution of (Δ + w) V = w V⁰; 0: nothing is attached. For
    /// symmetric Laplacians and backward Euler steps.
    double attachment = 0.0;
    /// The same with a w for each vertex, #V, in place of `attachment`: soft constraints, beside fixed_vertices. Empty:
    /// there are none.
    std::vector<double> attachment_weights = {};
    /// Scales the result of each step. The flow itself goes on unscaled, and distances to the undecomposed flow are
    /// unscaled, too; the conformalized flow goes on from the scaled result, so that it does not vanish on its way to a
    /// sphere. Every vertex that has faces moves: none of them may be fixed.
    Rescale rescale = Rescale::None;
    /// How far any vertex may end from where it was at first, above 0, in units of length: of each result, as the
    /// flow itself goes on as it is. Those that would go further are held at that distance, and the others give way
    /// smoothly (see DisplacementBound). Empty: they go as far as they do.
    std::optional<double> within = {};
    /// Of each result, as `within`. Not in distributed flows.
    ComponentLimits limits = {};
};

/// What a flow may use of the machine.
struct ResourceOptions {
    static constexpr int most_threads = 1024;

    /// Threads used, at most most_threads. 0: those of the calling TBB arena (all cores, where nothing limits it). The
    /// result is the same, bit for bit, for any number.
    int threads = 0;
    /// The most bytes that the factorisations of sub-meshes may take at once, at least 1. With less than one step
    /// needs, the flow throws an OptionError that tells how much that is. Empty: sweeps keep as few factorisations as
    /// keep all threads busy, converged steps keep all. With a limit, converged steps of symmetric Laplacians make the
    /// others again whenever they are needed, and factors that may be in either precision count as if in double
    /// precision; Δ_P needs all. UMFPACK's count by its own estimate. A limit asks for sub-meshes where the approach is
    /// automatic; their result does not depend on it. It does not hold for `reference`.
    std::optional<std::size_t> memory_limit = {};
    /// Whose factorisation solves the equations of sub-meshes. Changes the result by rounding alone. Converged steps of
    /// symmetric Laplacians have the library's own: their Schur complements come out of it.
    Factorisation factorisation = Factorisation::Automatic;
    /// In which precision the factors of converged steps of symmetric Laplacians are. In single precision they take
    /// half the memory and little more than half the time; as the residual is in double precision, steps converge to
    /// the same tolerance. With Precision::Single, equations that single precision makes indefinite end the flow.
    Precision precision = Precision::Automatic;
};

/// What a flow tells beside its result.
struct ReportOptions {
    /// Also run the undecomposed flow, by backward Euler steps whatever the scheme, and report the distance to it after
    /// each step.
    bool reference = false;
    /// Record what ran when, in which thread (FlowReport::schedule): 32 bytes for each task and step. Steps of
    /// Scheme::ExplicitEuler have no tasks.
    bool record_schedule = false;
    /// Also give the sub-meshes as they are, each with its own copy of Γ (FlowReport::separated, StepState::separated).
    /// For the classical conditions with Scheme::BackwardEuler alone: with others the copies are the same.
    bool keep_gaps = false;
    /// Measure mean curvature and displacements after each step, which takes a fifth to two thirds of its time. If not,
    /// they are 0 in the report.
    bool measures = true;
};

/// Everything that decides about a flow: `{.time_step = 0.05, .steps = 5, .cut = {.subdomains = 8}}`.
struct FlowOptions {
    static constexpr int most_steps = 1'000'000'000;

    /// Which discrete Laplacian drives the flow.
    Laplacian laplacian = Laplacian::Fujiwara;
    /// Whether the Laplacian's K follows the surface.
    FlowEquation flow = FlowEquation::MeanCurvature;
    /// A filter other than Diffusion of order 1 takes several solutions a step, with one factorisation: 8 and 11 for
    /// Diffusion of order 2 and 3, to a hundredth, m for LowPass of order m. For symmetric Laplacians and backward
    /// Euler steps, taken in any way; sweeps take it with predicted transmission alone, and keep all factors.
    Filter filter = Filter::Diffusion;
    /// That of the filter (see Filter). Empty: 1 for Diffusion, 2 for LowPass. Diffusion has 1 to 3, LowPass 2 to 8.
    std::optional<int> order = {};
    /// dt of one backward Euler step, in length²; √dt is about the distance over which one step smooths. Must be
    /// positive and finite, or 0 where `radius` says how much is smoothed.
    double time_step = 0.0;
    /// How much all steps together smooth, in place of time_step: bumps of this radius and smaller lose half their
    /// height or more (see smoothed_radius). Must be positive and finite. FlowReport::time_step is the dt that it
    /// takes.
    std::optional<LengthOnMesh> radius = {};
    /// With Laplacian::Uniform, its h: the length of edges, in length, that dt and radii are true of. 0: the mean of
    /// the mesh that is given. Must be finite, and not negative.
    double uniform_edge = 0.0;
    /// Number of steps, from 0 (which leaves the mesh as it is) to most_steps.
    int steps = 1;
    /// How a step is taken.
    Scheme scheme = Scheme::BackwardEuler;
    /// Keeps edges at which the normals of faces differ by more than this angle, in degrees, above 0 and below 180, and
    /// corners where such edges meet; 20 to 40 are good. What is smoother is smoothed. Each step then lets face normals
    /// diffuse by dt, but not across edges, and moves the vertices to fit them (see NormalDiffusion, fit_vertices): dt
    /// means what it means elsewhere, and as edges no longer suffer, ten to thirty squared mean edge lengths are good
    /// for one step; further steps begin anew from their surface. Fixed vertices stay, and a free boundary does not
    /// draw in. There are no sub-meshes, no equations of the Laplacian (which is still that of the mean curvatures
    /// reported), and no undecomposed flow to compare with: what speaks of these is refused. Empty: mean curvature
    /// flow.
    std::optional<double> keep_edges = {};
    CutOptions cut = {};
    InterfaceOptions interface = {};
    AccuracyOptions accuracy = {};
    MotionOptions motion = {};
    ResourceOptions resources = {};
    ReportOptions report = {};

    /// The paper's method, generalised to many sub-meshes and nothing else: a fixed sweep and no improvements, whatever
    /// the defaults become.
    static FlowOptions plain();
};

/// Whether every sub-mesh keeps a copy of Γ of its own.
bool is_classical(Conditions conditions);

/// Whether the conditions have a tangential derivative, and with it the Ventcell parameter q.
bool has_tangential_derivative(Conditions conditions);

/// Whether M and K are those of Vᵏ in each step, and the step is nothing but (M + dt K) Vᵏ⁺¹ = M Vᵏ.
bool is_plain_flow(const FlowOptions& options);

/// The Laplacian with what it is scaled by.
ScaledLaplacian laplacian_of(const FlowOptions& options);

/// The filter of each step, as exact as steps are asked to be.
StepFilter filter_of(const FlowOptions& options);

/// Whether sub-meshes tell each other in a sweep what they would do.
bool predicts(const FlowOptions& options);

/// Whether vertices are attached to where they are at first.
bool attaches(const MotionOptions& motion);

/// Whether steps are taken without sub-meshes.
bool takes_whole_mesh(Approach approach);

}  // namespace seamflow
