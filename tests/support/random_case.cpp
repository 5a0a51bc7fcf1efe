#include "tests/support/random_case.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stop_token>
#include <utility>

#include "engine/setup/automatic_choices.h"
#include "engine/state/checkpoint.h"
#include "engine/state/flow_state.h"
#include "engine/surface/origin_offset.h"
#include "partition/surface_components.h"
#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/memory_limits.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/undecomposed_step.h"

namespace seamflow::test {

namespace {

/// The mesh without faces that have the vertices of one before them, where it is not manifold: two faces that have all
/// their edges in common, and no others, are a closed surface.
PolygonMesh without_repetitions(const PolygonMesh& mesh)
{
    PolygonMesh left;
    left.vertices = mesh.vertices;
    const Topology topology = make_topology(mesh);
    const auto is_manifold = [&](Index v) { return topology.kind[v] != VertexKind::NonManifold; };
    std::set<std::vector<Index>> seen;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        std::sort(corners.begin(), corners.end());
        if (std::all_of(corners.begin(), corners.end(), is_manifold) || seen.insert(std::move(corners)).second)
            left.add_face(mesh.face(f));
    }
    return left;
}

/// Who cannot move for reasons that count edges alone: vertices on edges of one face or of three or more, or without
/// faces. Faces that repeat others do not count.
std::vector<Index> vertices_that_stay(const PolygonMesh& mesh, const FlowOptions& options)
{
    std::map<std::pair<Index, Index>, int> edges;
    std::vector<int> has_face(mesh.n_vertices(), 0);
    // Sub-meshes with copies of Γ of their own have all faces.
    const PolygonMesh left = options.report.keep_gaps ? mesh : without_repetitions(mesh);
    for (Index f = 0; f < left.n_faces(); ++f)
        for (std::size_t k = 0; k < left.face(f).size(); ++k) {
            const Index a = left.face(f)[k];
            const Index b = left.face(f)[(k + 1) % left.face(f).size()];
            has_face[a] = 1;
            ++edges[std::minmax(a, b)];
        }
    std::vector<Index> stay = options.motion.fixed_vertices;
    const bool hold_junctions = options.motion.junctions == Junctions::Hold || !need_of_junctions(options).empty();
    for (const auto& [edge, n_faces] : edges)
        if ((n_faces > 2 && hold_junctions) || (n_faces == 1 && options.motion.boundary == Boundary::Fixed))
            stay.insert(stay.end(), {edge.first, edge.second});
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (has_face[v] == 0)
            stay.push_back(v);
    return stay;
}

void check_same(Case& c, const Outcome& outcome, const std::string& what)
{
    c.expect(outcome.refusal == c.expected.refusal, what + ": " + outcome.refusal + " " + outcome.message);
    c.expect(outcome.states.size() == c.expected.states.size(), what + ": another number of steps");
    c.expect(same_bits(outcome.end, c.expected.end), what + ": other bits");
}

bool is_exact(const FlowReport& report, const FlowOptions& options)
{
    if (report.convergence.approach == Approach::ConjugateGradients)
        return false;
    // Rows of Δ_P depend on the faces across edges that join two boundary vertices, too.
    return options.laplacian == Laplacian::PtackovaVelho ? report.cut.n_sub_meshes() <= 1
                                                         : report.cut.interface_vertices == 0;
}

/// Every step against the same one of the whole mesh, by elimination.
/// @param tolerance to which the steps are converged.
void compare_with_undecomposed(Case& c, const Outcome& outcome, double tolerance, const std::string& what)
{
    // Far from the origin the states that the flow continues from have more digits than those it tells.
    const bool far = !origin_offset(c.mesh()).isZero(0.0);
    for (std::size_t step = 1; step < (far ? std::min<std::size_t>(2, outcome.states.size()) : outcome.states.size());
         ++step) {
        const Points& from = outcome.states[step - 1];
        const auto exact = undecomposed_step(c.mesh(), c.flow.options, from);
        if (!exact)
            return;
        const double moved = largest_difference(exact->positions, from);
        const double most = exact->rounding + 10.0 * tolerance * exact->condition * moved;
        const double distance = largest_difference(exact->positions, outcome.states[step]);
        ++c.n_compared[what];
        c.expect(distance <= most, what + " step " + std::to_string(step) + " is " + text_of(distance / moved) +
                                       " of its length off, may be " + text_of(most / moved));
    }
}

/// A component as a whole.
struct Extent {
    double area = 0.0;
    double volume = 0.0;
    Point centroid = Point::Zero();
};

/// Volume and centroid from `origin`.
Extent measure(const PolygonMesh& mesh, const Points& positions, const Point& origin)
{
    Extent extent;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Point normal = vector_area(mesh.face(f), positions);
        const Point middle = centroid(mesh.face(f), positions) - origin;
        extent.area += normal.norm();
        extent.volume += normal.dot(middle) / 3.0;
        extent.centroid += normal.norm() * middle;
    }
    extent.centroid /= extent.area;
    return extent;
}

}  // namespace

Case random_case(std::uint32_t seed)
{
    Case made{.flow = random_flow(seed), .random = RandomNumbers(seed ^ 0x9e3779b9U)};
    made.flow.options.resources.threads = 1;
    made.expected = outcome_of(made.mesh(), made.flow.options);
    return made;
}

void check_result(Case& c)
{
    const FlowOptions& options = c.flow.options;
    c.expect(c.expected.end.allFinite(), "the result is not finite");
    c.expect(same_bits(c.expected.end, c.expected.states.back()), "the mesh is not as the observer saw it last");
    for (const Index v : vertices_that_stay(c.mesh(), options))
        c.expect(c.expected.end.row(v) == c.mesh().vertices.row(v), "vertex " + std::to_string(v) + " has moved");
    if (!c.expected.refusal.empty()) {
        c.expect(c.expected.message.size() > 20, "refused without a reason");
        return;
    }
    const FlowReport& report = c.expected.report;
    c.expect(static_cast<int>(report.steps.size()) == options.steps, "the report has not all steps");
    c.expect(static_cast<Index>(report.cut.labels.size()) == c.mesh().n_faces(), "the report has not all labels");
    c.expect(report.mesh.faces == c.mesh().n_faces() && report.mesh.vertices == c.mesh().n_vertices(),
             "the report is of another");
}

void check_threads(Case& c)
{
    for (const int threads : {2, 5}) {
        FlowOptions options = c.flow.options;
        options.resources.threads = threads;
        check_same(c, outcome_of(c.mesh(), options), std::to_string(threads) + " threads");
    }
}

/// The least limit, which a lower one is refused with.
void check_memory_limit(Case& c)
{
    // A limit is about sub-meshes, and so asks for them.
    if (c.flow.options.accuracy.approach == Approach::Automatic && c.expected.refusal.empty() &&
        takes_whole_mesh(c.expected.report.convergence.approach))
        return;
    FlowOptions options = c.flow.options;
    options.resources.threads = 3;
    options.resources.memory_limit = 1;
    const Outcome refused = outcome_of(c.mesh(), options);
    const auto least = least_limit_named(refused.message);
    if (!least) {
        check_same(c, refused, "a memory limit of 1");
        return;
    }
    ++c.n_compared["memory limit"];
    c.expect(same_bits(refused.end, c.mesh().vertices), "a refusal has moved the mesh");
    options.resources.memory_limit = *least + (c.random.unit() < 0.5 ? 0 : 1 + usize(c.random.below(100'000)));
    const Outcome limited = outcome_of(c.mesh(), options);
    check_same(c, limited, "memory limit " + std::to_string(*options.resources.memory_limit));
    c.expect(limited.report.resources.factor_memory_bytes <= *options.resources.memory_limit,
             "more memory than the limit");
}

void check_resume(Case& c)
{
    const Outcome captured = outcome_of(c.mesh(), c.flow.options, {}, true);
    if (captured.captured.empty())
        return;
    FlowState state = captured.captured.at(usize(c.random.below(static_cast<int>(captured.captured.size()))));
    if (c.random.unit() < 0.3) {
        const TemporaryDirectory folder;
        write_checkpoint(folder / "state", state);
        state = *read_checkpoint(folder / "state");
    }
    FlowOptions options = c.flow.options;
    options.resources.threads = 2;
    const auto done = static_cast<std::size_t>(state.n_steps());
    const Outcome resumed =
        outcome_of(c.mesh(), options, {.resume = std::make_shared<const FlowState>(std::move(state))});
    ++c.n_compared["resumed"];
    c.expect(resumed.refusal == c.expected.refusal, "resumed: " + resumed.refusal + " " + resumed.message);
    c.expect(same_bits(resumed.end, c.expected.end), "resumed after step " + std::to_string(done) + ": other bits");
    for (std::size_t i = 1; i < resumed.states.size(); ++i)
        c.expect(same_bits(resumed.states[i], c.expected.states.at(done + i)), "resumed: another step");
}

void check_cancelled(Case& c)
{
    std::stop_source source;
    const double when = c.random.unit();
    const FlowControl control{.stop = source.get_token(), .on_progress = [&](const FlowProgress& progress) {
                                  if (progress.fraction >= when)
                                      source.request_stop();
                              }};
    const Outcome outcome = outcome_of(c.mesh(), c.flow.options, control);
    if (outcome.refusal != "Cancelled") {
        check_same(c, outcome, "hardly stopped");
        return;
    }
    ++c.n_compared["stopped"];
    c.expect(outcome.states.size() <= c.expected.states.size(), "stopped after its end");
    c.expect(same_bits(outcome.end, outcome.states.back()) &&
                 same_bits(outcome.end, c.expected.states.at(outcome.states.size() - 1)),
             "stopped, but not as after a complete step");
}

void check_undecomposed(Case& c)
{
    const FlowOptions& options = c.flow.options;
    if (options.scheme == Scheme::ExplicitEuler || options.motion.rescale != Rescale::None ||
        !c.expected.refusal.empty())
        return;
    if (is_exact(c.expected.report, options))
        compare_with_undecomposed(c, c.expected, 0.0, "undecomposed");
    if (!c.expected.report.convergence.tolerance)
        return;
    FlowOptions converged = options;
    converged.accuracy.tolerance = 1e-10;
    converged.accuracy.converge_iterations = 300;
    const Outcome outcome = outcome_of(c.mesh(), converged);
    if (outcome.report.convergence.steps_short_of_tolerance == 0 && outcome.refusal.empty())
        compare_with_undecomposed(c, outcome, 1e-10, "converged");
}

namespace {

/// @param unscaled #V by 3: the result without rescaling.
void check_rescaled_body(Case& c, const PolygonMesh& body, const Points& unscaled)
{
    const Rescale kind = c.flow.options.motion.rescale;
    const Point origin = body.vertices.row(body.face(0)[0]);
    const Extent before = measure(body, body.vertices, origin);
    const Extent after = measure(body, c.expected.end, origin);
    // What has shrunk to little loses digits when it is blown up again, and a volume is what is left of parts that
    // cancel each other.
    const double scale = std::sqrt(after.area / measure(body, unscaled, origin).area);
    const double near = (c.mesh().vertices.rowwise() - origin_offset(c.mesh())).cwiseAbs().maxCoeff();
    const double lost = 1e-14 * ((1.0 + scale) * near + c.expected.end.cwiseAbs().maxCoeff());
    const double size = std::max(c.extent(), box_of_faces(c.mesh(), c.expected.end).diagonal());
    const double most = 1e-10 + lost * size / std::min(before.area, after.area);
    const double full = std::pow(std::max(before.area, after.area), 1.5);
    const double part = kind == Rescale::Area ? 1.0 : std::min(1.0, std::abs(before.volume) / full);
    const double ratio = kind == Rescale::Area ? after.area / before.area : after.volume / before.volume;
    ++c.n_compared["rescaled"];
    c.expect(std::abs(ratio - 1.0) < most / part, "rescaled to another size, times " + text_of(ratio));
    c.expect((after.centroid - before.centroid).norm() < most * size,
             "rescaled to another place, " + text_of((after.centroid - before.centroid).norm() / c.extent()) +
                 " extents away, may be " + text_of(most));
}

}  // namespace

void check_rescaled(Case& c)
{
    const Rescale kind = c.flow.options.motion.rescale;
    if (kind == Rescale::None || !c.expected.refusal.empty())
        return;
    const PolygonMesh mesh = without_repetitions(c.mesh());
    // A component of which too little is left stays, with a remark.
    if (std::ranges::any_of(c.expected.report.remarks,
                            [](const Remark& remark) { return remark.kind == "not rescaled"; }))
        return;
    FlowOptions options = c.flow.options;
    options.motion.rescale = Rescale::None;
    const Points unscaled = outcome_of(c.mesh(), options).end;
    PolygonMesh joined = mesh;
    if (const std::vector<Index>& with = c.expected.report.mesh.moved_with; !with.empty())
        for (Index& v : joined.face_vertices)
            v = with[v];
    const SurfaceComponents bodies = surface_components(joined);
    for (Index b = 0; b < bodies.count(); ++b) {
        PolygonMesh body{.vertices = mesh.vertices, .face_offsets = {0}, .face_vertices = {}};
        for (const Index f : bodies.faces[b])
            body.add_face(mesh.face(f));
        check_rescaled_body(c, body, unscaled);
    }
}

}  // namespace seamflow::test
