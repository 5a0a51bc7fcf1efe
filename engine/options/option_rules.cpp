#include "engine/options/option_rules.h"

#include <fmt/format.h>

#include "engine/options/motion_rules.h"
#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

using O = FlowOptions;
using Asked = AskedOptions;
using Rule = OptionRule<FlowOptions>;

bool takes_sweeps(const O& o)
{
    return o.accuracy.approach == Approach::Sweep && !o.accuracy.tolerance;
}

bool takes_gradients(const O& o)
{
    return o.accuracy.approach == Approach::ConjugateGradients;
}

bool is_rescaled(const O& o)
{
    return o.motion.rescale != Rescale::None;
}

bool has_direction(const O& o)
{
    return o.motion.direction.kind != MotionDirection::Kind::Any;
}

bool has_schwarz(const O& o)
{
    return o.interface.conditions == Conditions::Schwarz;
}

/// Whether the conditions or the scheme rule out converged steps.
bool excludes_converged_steps(const O& o)
{
    return o.interface.conditions != Conditions::AdaptedRobin || o.scheme != Scheme::BackwardEuler;
}

bool is_cut(const O& o, const Asked& asked)
{
    return o.cut.subdomains > 1 || asked.has("labels");
}

bool is_attached(const Asked& asked)
{
    return asked.has("attachment") || asked.has("attachment_radius") || asked.has("attachment_weights");
}

bool is_plain(const O& o, const Asked& asked)
{
    return is_plain_flow(o) && !is_attached(asked);
}

/// Whether the filter is another than diffusion of order 1.
bool has_further_filter(const O& o)
{
    return !filter_of(o).is_plain();
}

/// Whether a symmetric Laplacian is to be factorised by another library: only this library's own factorisation gives
/// Schur complements, and keeps factors.
bool lacks_own(const O& o)
{
    return is_foreign(o.resources.factorisation) && is_symmetric(o.laplacian);
}

/// The rules on options of Γ.
constexpr Rule of_interface[]{
    {[](const O& o, const Asked&) { return o.interface.q && !has_tangential_derivative(o.interface.conditions); }, 0,
     "<q> is given, but belongs only to the Ventcell conditions"},
    {[](const O& o, const Asked&) { return !o.interface.q && has_tangential_derivative(o.interface.conditions); }, 0,
     "<conditions {conditions}> needs <q>, the Ventcell parameter (see (20) to (25) of the paper)"},
    {[](const O& o, const Asked&) { return has_schwarz(o) && o.interface.sweep == Sweep::Alternating; }, 0,
     "<sweep> is alternating, but with the Schwarz conditions sub-meshes overlap for one order of solving only: leave "
     "the sweep fixed"},
    {[](const O& o, const Asked&) { return has_schwarz(o) && o.interface.p; }, 0,
     "<p> is given, but the Schwarz conditions have no Robin parameter"},
    {[](const O& o, const Asked&) {
         return is_classical(o.interface.conditions) && o.interface.correction == Correction::Centroid;
     },
     0,
     "correction is centroid, but with the classical conditions every sub-mesh has an interface of its own: leave it "
     "uncorrected"},
    {[](const O& o, const Asked&) { return o.report.keep_gaps && !is_classical(o.interface.conditions); }, 0,
     "<keep_gaps> is for the classical Robin and Ventcell conditions; with others there are no gaps"},
    {[](const O& o, const Asked&) { return o.report.keep_gaps && o.scheme != Scheme::BackwardEuler; }, 0,
     "<keep_gaps> is for backward Euler steps; explicit ones are taken undecomposed, without gaps"},
};

/// The rules on the amount, and on constraints on motion that not all flows can have.
constexpr Rule of_motion_of_flows[]{
    {[](const O&, const Asked& asked) {
         return asked.has("time_step") + asked.has("time_step_edges") + asked.has("radius") > 1;
     },
     0, "<time_step>, <time_step_edges> and <radius> all say how much to smooth: give one of them"},
    {[](const O& o, const Asked&) { return o.motion.boundary == Boundary::Free && !is_symmetric(o.laplacian); }, 0,
     "<boundary> is free, but the Laplacian {laplacian} has no natural boundary conditions (its rows there are "
     "one-sided and unstable): use {symmetric}, or leave the boundary fixed"},
    {[](const O& o, const Asked& asked) {
         return o.report.keep_gaps && (is_rescaled(o) || asked.has("within") || o.motion.limits.exist());
     },
     0, "<rescale>, <within> and limits are for results whose sub-meshes are joined; <keep_gaps> leaves them separate"},
    {[](const O&, const Asked& asked) { return asked.has("strength"); }, concern::sweeps,
     "<strength> is given, whose steps are converged or undecomposed, but <{other}> is for sweeps: leave one of them "
     "out"},
    {[](const O& o, const Asked& asked) { return asked.has("strength") && takes_sweeps(o); }, 0,
     "<strength> is given, whose steps are converged or undecomposed, but <approach sweep> is for sweeps: leave one of "
     "them out"},
    {[](const O& o, const Asked& asked) {
         return asked.has("strength") && lacks_own(o) && o.accuracy.approach != Approach::Undecomposed;
     },
     0,
     "<strength> is given, whose steps in sub-meshes need this library's own factorisation: leave <factorisation> "
     "out, or take undecomposed steps"},
    {[](const O& o, const Asked&) {
         return has_direction(o) && (is_classical(o.interface.conditions) || has_schwarz(o));
     },
     0,
     "<direction> is for flows with one copy of each vertex, but with the classical and the Schwarz conditions every "
     "sub-mesh has its own: use other conditions"},
};

/// The rules on flows that are not plain mean curvature flow.
constexpr Rule of_flow[]{
    {[](const O& o, const Asked& asked) { return !is_plain(o, asked) && !is_symmetric(o.laplacian); }, 0,
     "{further}, but the Laplacian {laplacian} is not symmetric: use {symmetric}"},
    {[](const O& o, const Asked& asked) { return !is_plain(o, asked) && o.scheme != Scheme::BackwardEuler; }, 0,
     "{further}, which is for backward Euler steps: leave out the explicit scheme"},
    {[](const O& o, const Asked&) { return o.flow == FlowEquation::Conformalized && takes_gradients(o); }, 0,
     "{further}, but approach is by conjugate gradients, which support only mean curvature and linear flows: "
     "leave <approach> automatic"},
    {[](const O& o, const Asked&) { return o.flow == FlowEquation::Linear; }, concern::sweeps,
     "<{other}> is about sweeps, but <flow linear> takes none: leave one of them out"},
    {[](const O& o, const Asked&) { return o.flow == FlowEquation::Linear && takes_sweeps(o); }, 0,
     "<approach sweep> is about sweeps, but <flow linear> takes none: leave one of them out"},
    {[](const O& o, const Asked&) { return has_further_filter(o) && !predicts(o); }, 0,
     "{further}, which sweeps support only with adapted Robin conditions and predicted "
     "transmission: leave out other conditions, the derivatives, and <p>"},
};

/// The rules on the approach and the tolerance.
constexpr Rule of_steps[]{
    {[](const O& o, const Asked&) { return o.accuracy.tolerance && excludes_converged_steps(o); }, 0,
     "<tolerance> is given, which rules out other conditions and an explicit scheme"},
    {[](const O& o, const Asked&) { return o.accuracy.approach == Approach::Converged && excludes_converged_steps(o); },
     0, "<approach> is converged, which rules out other conditions and an explicit scheme"},
    {[](const O& o, const Asked&) { return takes_whole_mesh(o.accuracy.approach); }, concern::sweeps | concern::method,
     "<approach> is {approach}, which rules out <{other}>: leave one of them out"},
    {[](const O& o, const Asked& asked) { return takes_whole_mesh(o.accuracy.approach) && is_cut(o, asked); }, 0,
     "<approach> is {approach}, which takes the whole mesh: leave out the sub-meshes"},
    {[](const O& o, const Asked&) { return takes_gradients(o) && !is_symmetric(o.laplacian); }, 0,
     "<approach> is by conjugate gradients, but the Laplacian {laplacian} is not symmetric: use {symmetric}, or leave "
     "<approach> automatic"},
    {[](const O& o, const Asked&) { return takes_gradients(o); }, concern::factors,
     "<approach> is {approach}, but conjugate gradients factorise nothing: leave <{other}> out"},
};

/// The rules on the direct solver.
constexpr Rule of_factorisation[]{
    {[](const O& o, const Asked&) { return lacks_own(o) && o.flow == FlowEquation::Linear; }, 0,
     "<factorisation> is by another library, but only this library's own keeps the factors that the linear flow needs: "
     "leave the factorisation automatic"},
    {[](const O& o, const Asked&) {
         return lacks_own(o) && (o.accuracy.tolerance || o.accuracy.approach == Approach::Converged);
     },
     0,
     "<factorisation> is by another library, but converged steps of symmetric Laplacians need the Schur complements "
     "that this library's own provides: use sweeps (<approach sweep>), or leave the factorisation automatic"},
    {[](const O& o, const Asked&) { return !is_available(o.resources.factorisation); }, 0,
     "<factorisation> is {factorisation}, but this build has no libraries under the GPL (SEAMFLOW_GPL=OFF): leave the "
     "factorisation automatic"},
};

/// The option that asks for more than plain mean curvature flow, as the beginning of a sentence.
std::string further_flow(const O& o)
{
    if (o.flow != FlowEquation::MeanCurvature)
        return fmt::format("<flow> is {}", option_name(o.flow));
    return has_further_filter(o) ? fmt::format("<filter> is {}, of order {}", option_name(o.filter), filter_of(o).order)
                                 : "vertices are attached";
}

}  // namespace

AskedOptions changed_options(const FlowOptions& options)
{
    const auto has = [&options](std::string_view option) {
        bool is_changed = false;
        for_each_option(options, FlowOptions{}, [&](const auto& row, const auto& by_default) {
            is_changed = is_changed || (row.field == option && *row.value != *by_default.value);
        });
        return is_changed;
    };
    return {has, [&options](unsigned concerns) { return std::string(first_set(options, concerns)); }};
}

std::string fill_in(const FlowOptions& options, std::string_view text, std::string_view other)
{
    return fmt::format(fmt::runtime(text), fmt::arg("other", other), fmt::arg("laplacian", name_of(options.laplacian)),
                       fmt::arg("symmetric", names_of_symmetric_laplacians()),
                       fmt::arg("approach", option_name(options.accuracy.approach)),
                       fmt::arg("conditions", option_name(options.interface.conditions)),
                       fmt::arg("factorisation", option_name(options.resources.factorisation)),
                       fmt::arg("further", further_flow(options)));
}

void require_compatible(const FlowOptions& options, const AskedOptions& asked)
{
    const FillText fill = [&](std::string_view text, std::string_view other) { return fill_in(options, text, other); };
    require_none_broken<FlowOptions>(of_interface, options, asked, fill);
    require_compatible(options.motion, asked);
    for (const std::span<const Rule> rules : {std::span<const Rule>(of_motion_of_flows), std::span<const Rule>(of_flow),
                                              std::span<const Rule>(of_steps), std::span<const Rule>(of_factorisation)})
        require_none_broken(rules, options, asked, fill);
}

}  // namespace seamflow
