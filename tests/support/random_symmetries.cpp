#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/surface/origin_offset.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/random_case.h"
#include "tests/support/undecomposed_step.h"

namespace seamflow::test {

namespace {

/// Whether p* enters, which depends on the unit of length.
bool has_unit(const FlowOptions& options)
{
    return !options.interface.p &&
           (options.interface.conditions != Conditions::AdaptedRobin ||
            options.interface.transmission == Transmission::Derivative || options.interface.p_rule != PRule::Paper ||
            options.interface.p_edge != PEdge::Automatic);
}

/// Whether other numbers of the faces leave the sub-meshes what they are.
bool is_cut_alike(const Case& c)
{
    const FlowReport& report = c.expected.report;
    if (c.flow.options.scheme == Scheme::ExplicitEuler || report.cut.n_sub_meshes() <= 1)
        return true;
    return !c.flow.options.cut.labels.empty() && c.flow.options.interface.colouring == Colouring::Label &&
           report.cut.repaired_faces == 0 && !report.convergence.tolerance;
}

FlowOptions renumbered(FlowOptions options, const std::vector<Index>& new_vertex, const std::vector<Index>& old_face)
{
    std::vector<Index> labels;
    for (const Index f : old_face)
        if (!options.cut.labels.empty())
            labels.push_back(options.cut.labels[f]);
    options.cut.labels = std::move(labels);
    for (Index& v : options.motion.fixed_vertices)
        v = new_vertex[v];
    return options;
}

/// A rotation and a shift.
struct Motion {
    Eigen::Matrix3d turn;
    Point shift;

    [[nodiscard]] Points applied(const Points& points) const { return (points * turn.transpose()).rowwise() + shift; }
};

Motion random_motion(RandomNumbers& random, double extent)
{
    const Eigen::Vector3d axis(random.symmetric(), random.symmetric(), random.symmetric() + 2.0);
    return {Eigen::AngleAxisd(3.0 * random.unit(), axis.normalized()).toRotationMatrix(),
            extent * Point(random.symmetric(), random.symmetric(), random.symmetric())};
}

/// Whether rounding decides if the flow can go on: where next to nothing is left of a surface, the equations of the
/// next step may be singular or not.
bool may_be_singular_when_perturbed(Case& c)
{
    constexpr int attempts = 20;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        PolygonMesh mesh = c.mesh();
        perturb(mesh.vertices, c.random);
        if (outcome_of(mesh, c.flow.options).refusal == "ComputationError")
            return true;
    }
    return false;
}

}  // namespace

void check_mirrored_and_scaled(Case& c)
{
    // What is subtracted far from the origin is rounded, and half a grid is rounded away from 0.
    if (!origin_offset(c.mesh()).isZero(0.0) || c.expected.refusal == "ComputationError")
        return;
    FlowOptions options = c.flow.options;
    const double scale = has_unit(options) ? 1.0 : std::exp2(c.random.below(41) - 20);
    const Point factors(scale, c.random.unit() < 0.5 ? scale : -scale, c.random.unit() < 0.5 ? scale : -scale);
    PolygonMesh mesh = c.mesh();
    mesh.vertices.array().rowwise() *= factors.array();
    options.time_step *= scale * scale;
    if (options.interface.p)
        options.interface.p = *options.interface.p / scale;
    const Outcome outcome = outcome_of(mesh, options);
    ++c.n_compared["mirrored and scaled"];
    c.expect(outcome.refusal == c.expected.refusal, "mirrored and scaled: " + outcome.refusal + outcome.message);
    c.expect(outcome.end == Points(c.expected.end.array().rowwise() * factors.array()),
             "times " + text_of(factors.x()) + " " + text_of(factors.y()) + " " + text_of(factors.z()) +
                 ": another result");
}

void check_turned_and_renumbered(Case& c)
{
    // Bad shapes make more of rounding than two runs tell.
    const FlowOptions& options = c.flow.options;
    if (!c.is_sound() || !c.expected.refusal.empty() || !is_cut_alike(c))
        return;
    PolygonMesh perturbed = c.mesh();
    perturb(perturbed.vertices, c.random);
    const Outcome of_perturbed = outcome_of(perturbed, options);
    if (!of_perturbed.refusal.empty())
        return;
    const double most = 1e-9 * c.extent() + 1e4 * largest_difference(of_perturbed.end, c.expected.end);
    const auto new_vertex = random_permutation(c.mesh().n_vertices(), c.random);
    const auto old_face = random_permutation(c.mesh().n_faces(), c.random);
    const Motion motion = random_motion(c.random, c.extent());
    PolygonMesh mesh = renumbered(c.mesh(), new_vertex, old_face);
    mesh.vertices = motion.applied(mesh.vertices);
    const Outcome outcome = outcome_of(mesh, renumbered(options, new_vertex, old_face));
    if (!outcome.refusal.empty()) {
        c.expect(outcome.refusal == "ComputationError" && may_be_singular_when_perturbed(c),
                 "turned and renumbered: " + outcome.message);
        return;
    }
    ++c.n_compared["turned and renumbered"];
    const Points expected = motion.applied(c.expected.end);
    double distance = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        distance = std::max(distance, (outcome.end.row(new_vertex[v]) - expected.row(v)).norm());
    c.expect(distance <= most, "turned and renumbered: " + text_of(distance / c.extent()) + " extents off, may be " +
                                   text_of(most / c.extent()));
}

}  // namespace seamflow::test
