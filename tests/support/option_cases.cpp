#include "tests/support/option_cases.h"

#include <algorithm>

#include "solvers/laplacian/geometry.h"

namespace seamflow::test {

namespace {

using Setter = std::function<void(AllOptions&, const PolygonMesh&, double)>;

/// A change that depends on options alone.
template <class Change>
Setter plain(Change change)
{
    return [change](AllOptions& o, const PolygonMesh&, double) { change(o); };
}

/// Four parts in stripes, which any numbers of faces leave as they are.
void cut_into_stripes(AllOptions& o, const PolygonMesh& mesh)
{
    const auto x = mesh.vertices.col(0);
    o.cut.labels.clear();
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const double part = (centroid(mesh.face(f), mesh.vertices).x() - x.minCoeff()) / (x.maxCoeff() - x.minCoeff());
        o.cut.labels.push_back(static_cast<Index>(3.999 * part));
    }
    o.interface.colouring = Colouring::Label;
}

/// A case of sweeps over stripes.
template <class Change>
Setter sweeps(Change change)
{
    return [change](AllOptions& o, const PolygonMesh& mesh, double edge) {
        o.accuracy.tolerance.reset();
        o.accuracy.approach = Approach::Sweep;
        cut_into_stripes(o, mesh);
        if constexpr (requires { change(o, edge); })
            change(o, edge);
        else
            change(o);
    };
}

/// Every seventh vertex with faces.
std::vector<Index> some_vertices(const PolygonMesh& mesh)
{
    std::vector<Index> some;
    for (Index v = 3; v < mesh.n_vertices(); v += 7)
        some.push_back(v);
    return some;
}

/// From 0 to 1 along x.
std::vector<double> ramp(const PolygonMesh& mesh)
{
    std::vector<double> values;
    const auto x = mesh.vertices.col(0);
    for (const double at_x : x)
        values.push_back((at_x - x.minCoeff()) / (x.maxCoeff() - x.minCoeff()));
    return values;
}

/// Without those of libraries that the build lacks.
std::vector<OptionCase> of_this_build(std::vector<OptionCase> cases)
{
    if (gpl_parts().empty())
        std::erase_if(cases, [](const OptionCase& one) { return one.value == "cholmod" || one.value == "umfpack"; });
    return cases;
}

}  // namespace

AllOptions options_without_cases(double edge)
{
    AllOptions options(FlowOptions{.laplacian = Laplacian::VirtualRefinement, .time_step = edge * edge, .steps = 2});
    options.accuracy.tolerance = 1e-13;
    options.resources.threads = 1;
    return options;
}

const std::vector<OptionCase>& option_cases()
{
    using O = AllOptions;
    static const std::vector<OptionCase> list = of_this_build({
        {"laplacian", "fujiwara", plain([](O& o) { o.laplacian = Laplacian::Fujiwara; })},
        {"laplacian", "alexa-wardetzky", plain([](O& o) { o.laplacian = Laplacian::AlexaWardetzky; })},
        {"laplacian", "ptackova-velho", plain([](O& o) { o.laplacian = Laplacian::PtackovaVelho; })},
        {"laplacian", "uniform", plain([](O& o) { o.laplacian = Laplacian::Uniform; })},
        {"flow", "conformalized", plain([](O& o) { o.flow = FlowEquation::Conformalized; })},
        {"flow", "linear", plain([](O& o) { o.flow = FlowEquation::Linear; })},
        {"filter", "low-pass", plain([](O& o) { o.filter = Filter::LowPass; })},
        {"order", "3", plain([](O& o) { o.order = 3; })},
        {"time_step", "threefold", plain([](O& o) { o.time_step *= 3.0; })},
        {"radius", "length", [](O& o, const PolygonMesh&, double edge) { o.time_step = 0.0, o.radius = {2.0 * edge}; }},
        {"radius", "%", plain([](O& o) {
             o.time_step = 0.0, o.radius = {0.1, true};
         })},
        {"time_step_edges", "3", plain([](O& o) { o.time_step = 0.0, o.time_step_edges = 3.0; })},
        {"uniform_edge", "given",
         [](O& o, const PolygonMesh&, double edge) { o.laplacian = Laplacian::Uniform, o.uniform_edge = 0.7 * edge; }},
        {"steps", "3", plain([](O& o) { o.steps = 3; })},
        {"subdomains", "4", plain([](O& o) { o.cut.subdomains = 4; })},
        {"labels", "stripes", [](O& o, const PolygonMesh& mesh, double) { cut_into_stripes(o, mesh); }},
        {"scheme", "explicit",
         plain([](O& o) { o.scheme = Scheme::ExplicitEuler, o.accuracy.tolerance.reset(), o.time_step *= 0.01; })},
        {"conditions", "adapted-ventcell",
         sweeps([](O& o) { o.interface.conditions = Conditions::AdaptedVentcell, o.interface.q = 0.1; })},
        {"conditions", "robin", sweeps([](O& o, double edge) {
             o.interface.conditions = Conditions::Robin, o.interface.p = 2.0 / edge, o.time_step *= 0.1;
         })},
        {"conditions", "schwarz", sweeps([](O& o) { o.interface.conditions = Conditions::Schwarz; })},
        {"transmission", "derivative", sweeps([](O& o) { o.interface.transmission = Transmission::Derivative; })},
        {"p", "given", sweeps([](O& o, double edge) { o.interface.p = 2.0 / edge; })},
        {"p_rule", "inverse-step", sweeps([](O& o) { o.interface.p_rule = PRule::InverseStep; })},
        {"p_edge", "mean",
         sweeps([](O& o) { o.interface.p_edge = PEdge::Mean, o.interface.p_rule = PRule::InverseStep; })},
        {"q", "given", sweeps([](O& o, double edge) {
             o.interface.conditions = Conditions::Ventcell, o.interface.q = 0.2, o.interface.p = 2.0 / edge;
             o.time_step *= 0.1;
         })},
        {"overlap", "2", sweeps([](O& o) { o.interface.conditions = Conditions::Schwarz, o.interface.overlap = 2; })},
        {"correction", "none", sweeps([](O& o) { o.interface.correction = Correction::None; })},
        {"sweep", "fixed", sweeps([](O& o) { o.interface.sweep = Sweep::Fixed; })},
        {"colouring", "label", sweeps([](O& o) { o.interface.colouring = Colouring::Label; })},
        {"keep_gaps", "yes", sweeps([](O& o, double edge) {
             o.interface.conditions = Conditions::Robin, o.interface.p = 2.0 / edge, o.time_step *= 0.1;
             o.report.keep_gaps = true;
         })},
        {"tolerance", "tight", plain([](O& o) { o.accuracy.tolerance = 1e-12; })},
        {"converge_iterations", "500", plain([](O& o) { o.accuracy.converge_iterations = 500; })},
        {"approach", "sweep", sweeps([](O&) {})},
        {"approach", "converged", plain([](O& o) { o.accuracy.approach = Approach::Converged; })},
        {"approach", "cg", plain([](O& o) { o.accuracy.approach = Approach::ConjugateGradients; })},
        {"approach", "undecomposed",
         plain([](O& o) { o.accuracy.approach = Approach::Undecomposed, o.accuracy.tolerance.reset(); })},
        {"memory_limit", "given", sweeps([](O& o) { o.resources.memory_limit = 100'000'000; })},
        {"factorisation", "own", sweeps([](O& o) { o.resources.factorisation = Factorisation::Own; })},
        {"factorisation", "cholmod", sweeps([](O& o) { o.resources.factorisation = Factorisation::Cholmod; })},
        {"factorisation", "umfpack", sweeps([](O& o) { o.resources.factorisation = Factorisation::Umfpack; })},
        {"precision", "double",
         plain([](O& o) { o.resources.precision = Precision::Double, o.accuracy.approach = Approach::Converged; })},
        {"precision", "single",
         plain([](O& o) { o.resources.precision = Precision::Single, o.accuracy.approach = Approach::Converged; })},
        {"tune_for", "16", plain([](O& o) { o.resources.tune_for = 16; })},
        {"reference", "yes", sweeps([](O& o) { o.report.reference = true; })},
        {"keep_edges", "30", plain([](O& o) { o.keep_edges = 30.0, o.accuracy.tolerance.reset(); })},
        {"denoise", "yes", plain([](O& o) { o.denoise = true, o.accuracy.tolerance.reset(), o.steps = 1; })},
        {"rounded", "given",
         [](O& o, const PolygonMesh&, double edge) {
             o.denoise = true, o.accuracy.tolerance.reset(), o.steps = 1;
             o.rounded = {Rounding::Kind::Given, Point::Constant(0.2 * edge)};
         }},
        {"feature_edges", "some",
         [](O& o, const PolygonMesh& mesh, double) {
             o.keep_edges = 60.0, o.accuracy.tolerance.reset();
             for (Index f = 4; f < mesh.n_faces(); f += 9)
                 o.motion.feature_edges.push_back({mesh.face(f)[0], mesh.face(f)[1]});
         }},
        {"boundary", "free", plain([](O& o) { o.motion.boundary = Boundary::Free; })},
        {"smooth_rims", "yes", plain([](O& o) {
             o.smooth_rims = true, o.motion.boundary = Boundary::Free, o.accuracy.tolerance.reset();
         })},
        {"junctions", "hold", plain([](O& o) { o.motion.junctions = Junctions::Hold; })},
        {"fixed_vertices", "some",
         [](O& o, const PolygonMesh& mesh, double) { o.motion.fixed_vertices = some_vertices(mesh); }},
        {"attachment", "given",
         [](O& o, const PolygonMesh&, double edge) { o.motion.attachment = 0.3 / (edge * edge); }},
        {"attachment_radius", "length",
         [](O& o, const PolygonMesh&, double edge) { o.motion.attachment_radius = 2.0 * edge; }},
        {"attachment_radius", "%", plain([](O& o) {
             o.motion.attachment_radius = {0.1, true};
         })},
        {"attachment_weights", "ramp",
         [](O& o, const PolygonMesh& mesh, double edge) {
             o.motion.attachment_weights = ramp(mesh);
             for (double& w : o.motion.attachment_weights)
                 w /= edge * edge;
         }},
        {"strength", "ramp", [](O& o, const PolygonMesh& mesh, double) { o.motion.strength = ramp(mesh); }},
        {"feather", "length",
         [](O& o, const PolygonMesh& mesh, double edge) {
             o.motion.strength = ramp(mesh), o.motion.feather = 3.0 * edge;
         }},
        {"feather", "%",
         [](O& o, const PolygonMesh& mesh, double) {
             o.motion.strength = ramp(mesh), o.motion.feather = {0.2, true};
         }},
        {"direction", "vector", plain([](O& o) {
             o.motion.direction = {MotionDirection::Kind::Vector, Point(0.1, 0.2, 1.0)};
         })},
        {"direction", "normal", plain([](O& o) { o.motion.direction.kind = MotionDirection::Kind::Normal; })},
        {"weld", "distance", [](O& o, const PolygonMesh&, double edge) { o.motion.weld = 1e-3 * edge; }},
        {"weld", "%", plain([](O& o) {
             o.motion.weld = {1e-4, true};
         })},
        {"strict", "yes", plain([](O& o) { o.motion.strict = true; })},
        {"rescale", "area", plain([](O& o) { o.motion.rescale = Rescale::Area, o.motion.boundary = Boundary::Free; })},
        {"rescale", "volume",
         plain([](O& o) { o.motion.rescale = Rescale::Volume, o.motion.boundary = Boundary::Free; })},
        {"within", "given", [](O& o, const PolygonMesh&, double edge) { o.motion.within = 0.1 * edge; }},
        {"within", "%", plain([](O& o) {
             o.motion.within = LengthOnMesh{0.01, true};
         })},
        {"within", "along axes",
         [](O& o, const PolygonMesh&, double edge) {
             o.motion.within = {0.1 * edge, 0.05 * edge, 0.02 * edge};
         }},
        {"limit_of_volume", "given", plain([](O& o) { o.motion.limits.volume = 0.01; })},
        {"limit_of_move", "given", [](O& o, const PolygonMesh&, double edge) { o.motion.limits.move = 0.05 * edge; }},
        {"limit_of_slide", "given", [](O& o, const PolygonMesh&, double edge) { o.motion.limits.slide = 0.05 * edge; }},
        {"largest_update", "0.5", plain([](O& o) { o.accuracy.largest_update = 0.5; })},
        {"threads", "2", plain([](O& o) { o.resources.threads = 2; })},
        {"measures", "no", plain([](O& o) { o.report.measures = false; })},
        {"record_schedule", "yes", plain([](O& o) { o.report.record_schedule = true; })},
    });
    return list;
}

const OptionCase& option_case(std::string_view name)
{
    return *std::ranges::find(option_cases(), name, &OptionCase::name);
}

}  // namespace seamflow::test
