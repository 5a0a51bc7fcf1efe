#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/options/approach.h"
#include "engine/options/motion_options.h"
#include "partition/polygon_mesh.h"
#include "solvers/conditions/robin_edge.h"
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
    /// the shortest edge; a quarter of it is safe on regular grids. Above that the surface can become rough instead of
    /// smooth; the report then has a remark.
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
    /// Fixed for at most two sub-meshes and with Conditions::Schwarz, else Alternating.
    Automatic,
    /// The same order in every step, as in the paper.
    Fixed,
    /// First to last in the first step, last to first in the second, and so on by turns. Not with Conditions::Schwarz,
    /// whose overlaps are made for one order.
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

/// Resources of the machine.
struct ResourceOptions {
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
    /// The discrete Laplacian.
    Laplacian laplacian = Laplacian::Fujiwara;
    /// The flow: whether K and M of the Laplacian follow the surface.
    FlowEquation flow = FlowEquation::MeanCurvature;
    /// A filter other than Diffusion of order 1 takes several solutions a step, with one factorisation: 8 and 11 for
    /// Diffusion of order 2 and 3, to a hundredth, m for LowPass of order m. For symmetric Laplacians and backward
    /// Euler steps of any solver; sweeps need predicted transmission, and keep all factors.
    Filter filter = Filter::Diffusion;
    /// The order of the filter (see Filter). Empty: 1 for Diffusion, 2 for LowPass. Diffusion has 1 to 3, LowPass 2
    /// to 8.
    std::optional<int> order = {};
    /// dt of one step, in length²; one step smooths over a distance of about √dt. Must be positive and finite, or 0 if
    /// one of the next two gives the amount. FlowReport::time_step has the resulting dt.
    double time_step = 0.0;
    /// dt of one step, in squared mean edge lengths. Must be positive and finite.
    std::optional<double> time_step_edges = {};
    /// The amount of all steps together: bumps of this radius lose half their height, smaller ones more (see
    /// smoothed_radius; with uniform weights those of uneven meshes up to a tenth less). Must be positive and finite.
    std::optional<LengthOnMesh> radius = {};
    /// h of Laplacian::Uniform: the edge length, in length, for which dt and radii hold. 0: the mean edge length of the
    /// given mesh. Must be finite, and not negative.
    double uniform_edge = 0.0;
    /// Number of steps, from 0 (which leaves the mesh as it is) to most_steps.
    int steps = 1;
    /// The time integration scheme.
    Scheme scheme = Scheme::BackwardEuler;
    CutOptions cut = {};
    InterfaceOptions interface = {};
    AccuracyOptions accuracy = {};
    MotionOptions motion = {};
    ResourceOptions resources = {};
    ReportOptions report = {};

    /// The paper's method, generalised to many sub-meshes and nothing else: a fixed sweep and derivatives at Vᵏ. It
    /// does not change with the defaults.
    static FlowOptions plain();
};

/// Whether every sub-mesh keeps its own copy of Γ.
bool is_classical(Conditions conditions);

/// Whether the conditions have a tangential derivative, and with it the Ventcell parameter q.
bool has_tangential_derivative(Conditions conditions);

/// Whether each step is (M + dt K) Vᵏ⁺¹ = M Vᵏ with M and K of Vᵏ, and nothing else.
bool is_plain_flow(const FlowOptions& options);

/// The Laplacian with its scale.
ScaledLaplacian laplacian_of(const FlowOptions& options);

/// The filter of each step, as accurate as the steps of the approach and tolerance that the options ask for.
StepFilter filter_of(const FlowOptions& options);
/// The same for the approach and the tolerance with which steps are taken.
StepFilter filter_of(const FlowOptions& options, Approach approach, std::optional<double> tolerance);

/// Whether a sweep uses predictions of the other side of Γ.
bool predicts(const FlowOptions& options);

}  // namespace seamflow
