#include "engine/fields/diffuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/fields/thin_faces.h"
#include "engine/fields/white_noise.h"
#include "engine/flow.h"
#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "engine/setup/smoothed_radius.h"
#include "partition/connected_components.h"
#include "partition/errors.h"
#include "partition/weld.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/laplacian/degenerate.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

constexpr double default_tolerance = 1e-8;

/// Of one step in squared diagonals of the bounding box, after which what holds values alone decides.
constexpr double time_to_rest = 1e6;

void require_finite(const Eigen::MatrixXd& fields, Index n_vertices)
{
    if (fields.rows() != n_vertices)
        throw InputError(fmt::format("the fields have {} rows, but the mesh has {} vertices: give one for each",
                                     fields.rows(), n_vertices));
    for (Eigen::Index c = 0; c < fields.cols(); ++c)
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            if (std::isinf(fields(v, c)))
                throw InputError(fmt::format("column {} of the fields is infinite at vertex {} (both numbered from 0): "
                                             "give a finite number, or NaN where there are no data",
                                             c, v));
}

/// @throws OptionError for options that fields do not have.
void require_for_fields(const FlowOptions& options, const FieldOptions& of_fields)
{
    const auto refuse = [](std::string_view what, std::string_view remedy) {
        throw OptionError(fmt::format("{}: leave {} out", what, remedy));
    };
    if (!is_symmetric(options.laplacian))
        throw OptionError(fmt::format("fields diffuse by a symmetric matrix, which the Laplacian {} does not have: use "
                                      "{}",
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.flow == FlowEquation::Conformalized)
        refuse("fields diffuse on a surface that stays, which the conformalized flow is not for", "the flow");
    if (options.accuracy.approach == Approach::Sweep || !first_set(options, concern::sweeps).empty())
        refuse("the steps of fields are solved exactly, and not by sweeps over sub-meshes", "what concerns sweeps");
    const MotionOptions& motion = options.motion;
    if (attaches(motion) || motion.rescale != Rescale::None || motion.within || motion.limits.exist())
        refuse("fields diffuse on a surface that stays", "attachments, rescale, within and limits");
    if (!motion.strength.empty() || motion.direction.kind != MotionDirection::Kind::Any)
        refuse("fields diffuse on a surface that stays", "strength and direction");
    if (options.keep_edges)
        refuse("keep_edges is about the angles of a surface, which stays while fields diffuse", "it");
    if (options.report.reference)
        refuse("the steps of fields are solved exactly, so that there is nothing to compare with", "reference");
    const auto require_positive = [](const std::optional<double>& value, const char* name, const char* what) {
        if (value && !(*value > 0.0 && std::isfinite(*value)))
            throw OptionError(fmt::format("{} is {}, but must be positive and finite ({})", name, *value, what));
    };
    require_positive(of_fields.fwhm, "fwhm", "a length");
    require_positive(of_fields.keep_edges, "the difference of fields to keep", "in the unit of the fields");
    if (of_fields.fwhm && (options.time_step != 0.0 || options.radius))
        throw OptionError("fwhm and time_step or radius both say how much is smoothed: leave one of them out");
}

/// Those of the flow that is applied to fields.
FlowOptions options_of_flow(const PolygonMesh& mesh, const FlowOptions& options, const FieldOptions& of_fields)
{
    FlowOptions own = options;
    own.flow = FlowEquation::Linear;
    own.motion.boundary = of_fields.boundary;
    own.report = {.record_schedule = options.report.record_schedule, .measures = false};
    if (of_fields.fwhm)
        own.time_step = time_for_fwhm(*of_fields.fwhm) / std::max(options.steps, 1);
    own.time_step = time_step_of(own, mesh);
    own.radius.reset();
    if (!own.accuracy.tolerance && own.accuracy.approach != Approach::Undecomposed)
        own.accuracy.tolerance = default_tolerance;
    return own;
}

/// Columns whose data are at the same vertices.
struct Group {
    std::vector<Eigen::Index> columns;
    /// #V: 1 where there are none.
    std::vector<std::uint8_t> lacks;
    Index n_lacking = 0;
};

std::vector<Group> group_columns(const Eigen::MatrixXd& fields)
{
    std::vector<Group> groups;
    std::vector<std::uint8_t> lacks(static_cast<std::size_t>(fields.rows()));
    for (Eigen::Index c = 0; c < fields.cols(); ++c) {
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            lacks[static_cast<std::size_t>(v)] = std::isnan(fields(v, c)) ? 1 : 0;
        auto group = std::ranges::find(groups, lacks, &Group::lacks);
        if (group == groups.end())
            group = groups.insert(group, {{}, lacks, static_cast<Index>(std::ranges::count(lacks, 1))});
        group->columns.push_back(c);
    }
    return groups;
}

/// Whether K of a face cannot be used.
bool is_unusable(const PolygonMesh& mesh, Index f, Laplacian laplacian)
{
    return traits_of(laplacian).divisor == Divisor::FaceAreas && is_thin(mesh.face(f), mesh.vertices);
}

/// The same vertices, and the faces whose vertices all have data, but for faces without area; their labels, if there
/// are any.
PolygonMesh surface_of(const PolygonMesh& mesh, const Group& group, Laplacian laplacian, std::vector<Index>& labels)
{
    std::vector<Index> left;
    PolygonMesh surface = with_faces(mesh, [&](Index f) {
        const bool lacks = std::ranges::any_of(mesh.face(f), [&](Index v) { return group.lacks[v] != 0; });
        const bool is_kept = !lacks && !is_unusable(mesh, f, laplacian);
        if (is_kept && f < std::ssize(labels))
            left.push_back(labels[f]);
        return is_kept;
    });
    labels = std::move(left);
    return surface;
}

/// Columns in the unit in which their values spread about as far as the steps do, which powers of two change exactly:
/// what steps add fits in single precision.
class ScaledFields {
  public:
    ScaledFields(const Eigen::MatrixXd& fields, const Group& group, double time_step)
        : values_(fields(Eigen::all, group.columns))
        , units_(values_.cols())
    {
        for (Eigen::Index v = 0; v < values_.rows(); ++v)
            if (group.lacks[static_cast<std::size_t>(v)] != 0)
                values_.row(v).setZero();
        for (Eigen::Index c = 0; c < values_.cols(); ++c) {
            const double spread = spread_of(group, c);
            units_[c] = spread > 0.0 && std::isfinite(spread)
                            ? power_of_two_near(spread) / power_of_two_near(std::sqrt(time_step))
                            : 1.0;
        }
        values_.array().rowwise() /= units_.transpose().array();
    }

    Eigen::MatrixXd& values() { return values_; }

    [[nodiscard]] Eigen::MatrixXd in_units() const
    {
        return (values_.array().rowwise() * units_.transpose().array()).matrix();
    }

    /// Puts them where they came from.
    void write(const Group& group, Eigen::MatrixXd& fields) const
    {
        const Eigen::MatrixXd results = in_units();
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            for (std::size_t c = 0; group.lacks[static_cast<std::size_t>(v)] == 0 && c < group.columns.size(); ++c)
                fields(v, group.columns[c]) = results(v, static_cast<Eigen::Index>(c));
    }

  private:
    [[nodiscard]] double spread_of(const Group& group, Eigen::Index column) const
    {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        for (Eigen::Index v = 0; v < values_.rows(); ++v)
            if (group.lacks[static_cast<std::size_t>(v)] == 0) {
                least = std::min(least, values_(v, column));
                most = std::max(most, values_(v, column));
            }
        return most - least;
    }

    Eigen::MatrixXd values_;
    Eigen::VectorXd units_;
};

/// How many times the steps of the flow are taken: once for each three columns.
int n_blocks(Eigen::Index n_columns)
{
    return static_cast<int>((n_columns + 2) / 3);
}

/// Vertices that are joined along seams (see weld) with others that have data get the mean of these.
class SeamsOfFields {
  public:
    SeamsOfFields(const PolygonMesh& mesh, const MotionOptions& motion)
        : mesh_(mesh)
        , topology_(make_topology(mesh))
    {
        if (motion.weld)
            weld_ = weld(mesh, topology_, *motion.weld);
    }

    void complete(Group& group, Eigen::MatrixXd& fields) const
    {
        if (!weld_)
            return;
        const std::vector<std::uint8_t> lacked = group.lacks;
        std::vector<Index> n(lacked.size(), 0);
        for (std::size_t v = 0; v < lacked.size(); ++v)
            n[at(weld_->first[v])] += lacked[v] == 0 ? 1 : 0;
        for (const Eigen::Index c : group.columns) {
            std::vector<double> sums(lacked.size(), 0.0);
            for (std::size_t v = 0; v < lacked.size(); ++v)
                if (lacked[v] == 0)
                    sums[at(weld_->first[v])] += fields(static_cast<Eigen::Index>(v), c);
            for (std::size_t v = 0; v < lacked.size(); ++v)
                if (const std::size_t first = at(weld_->first[v]); lacked[v] != 0 && n[first] > 0) {
                    fields(static_cast<Eigen::Index>(v), c) = sums[first] / n[first];
                    group.lacks[v] = 0;
                }
        }
    }

    /// Whether a vertex is connected with one that has data, by faces.
    [[nodiscard]] std::vector<std::uint8_t> reached_from_data(const Group& group) const
    {
        const PolygonMesh& mesh = weld_ ? weld_->mesh : mesh_;
        const Topology& topology = weld_ ? weld_->topology : topology_;
        std::vector<std::uint8_t> reached(group.lacks.size(), 0);
        std::vector<Index> nodes;
        const auto first = [&](Index v) { return weld_ ? weld_->first[v] : v; };
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (group.lacks[v] == 0 && std::exchange(reached[first(v)], std::uint8_t{1}) == 0)
                append_reachable(first(v), nodes, [&](Index node, auto&& reach) {
                    for (const Index corner : topology.corners_at(node))
                        for (const Index w : mesh.face(topology.face_of[at(corner)]))
                            if (std::exchange(reached[w], std::uint8_t{1}) == 0)
                                reach(w);
                });
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            reached[v] = reached[first(v)];
        return reached;
    }

  private:
    const PolygonMesh& mesh_;
    Topology topology_;
    std::optional<Weld> weld_;
};

/// The faces over which data are extended: not those of vertices without data that would be held, and so would act as
/// data, because they have no row or because sheets merely touch there.
PolygonMesh surface_for_extension(const PolygonMesh& mesh, const Group& group, Laplacian laplacian)
{
    const PolygonMesh sound = with_faces(mesh, [&](Index f) { return !is_unusable(mesh, f, laplacian); });
    Topology topology = make_topology(sound);
    free_junctions(sound, topology, run_serially);
    free_boundary(topology);
    std::vector<std::uint8_t> is_held(at(mesh.n_vertices()), 0);
    for (const Index v : vertices_without_row(sound, topology, laplacian))
        is_held[v] = group.lacks[v];
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::NonManifold)
            is_held[v] = group.lacks[v];
    return with_faces(
        sound, [&](Index f) { return std::ranges::none_of(sound.face(f), [&](Index v) { return is_held[v] != 0; }); });
}

/// The means of columns over the vertices with data.
Eigen::RowVectorXd means_of(const Eigen::MatrixXd& fields, const Group& group)
{
    Eigen::RowVectorXd means = Eigen::RowVectorXd::Zero(fields.cols());
    double n = 0.0;
    for (Eigen::Index v = 0; v < fields.rows(); ++v)
        if (group.lacks[static_cast<std::size_t>(v)] == 0) {
            n += 1.0;
            for (const Eigen::Index c : group.columns)
                means[c] += (fields(v, c) - means[c]) / n;
        }
    return means;
}

/// The harmonic extension, as what a long step makes of it.
void extend(const PolygonMesh& mesh, Group& group, const FlowOptions& options, const FlowControl& control,
            Eigen::MatrixXd& fields, FieldReport& report)
{
    const Index n_lacking = group.n_lacking;
    PolygonMesh surface = surface_for_extension(mesh, group, options.laplacian);
    const SeamsOfFields seams(surface, options.motion);
    seams.complete(group, fields);
    const std::vector<std::uint8_t> reached = seams.reached_from_data(group);
    FlowOptions own = options;
    own.filter = Filter::Diffusion;
    own.order.reset();
    own.steps = n_blocks(std::ssize(group.columns));
    own.accuracy.approach = Approach::Automatic;
    own.accuracy.tolerance = default_tolerance;
    own.cut = {};
    own.motion.boundary = Boundary::Free;
    own.motion.junctions = Junctions::Flow;
    own.motion.fixed_vertices.clear();
    own.time_step =
        time_to_rest * (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).squaredNorm();
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (group.lacks[v] == 0 || reached[v] == 0)
            own.motion.fixed_vertices.push_back(v);
    // Far from 0, M would pull towards it.
    const Eigen::RowVectorXd means = means_of(fields, group);
    Eigen::MatrixXd extended = fields.rowwise() - means;
    Flow flow(surface, own, {}, control);
    ScaledFields scaled(extended, group, own.time_step);
    flow.diffuse(scaled.values());
    const std::vector<std::uint8_t> lacked = group.lacks;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        group.lacks[v] = lacked[v] != 0 && reached[v] != 0 ? 0 : 1;
    scaled.write(group, extended);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const Eigen::Index c : group.columns)
            if (group.lacks[v] == 0)
                fields(v, c) = extended(v, c) + means[c];
    const auto is_known = [&](Index v) { return !std::isnan(fields(v, group.columns.front())); };
    Index n_known = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        n_known += is_known(v) ? 1 : 0;
    report.filled += n_known - (mesh.n_vertices() - n_lacking);
}

/// Adds what was reported on columns before.
void add_up(const FlowReport& before, FlowReport& report)
{
    report.convergence.steps_short_of_tolerance += before.convergence.steps_short_of_tolerance;
    report.convergence.steps_stagnated += before.convergence.steps_stagnated;
    report.seconds.cut += before.seconds.cut;
    report.seconds.analyse += before.seconds.analyse;
    report.seconds.step += before.seconds.step;
    for (const std::string& remark : before.remarks)
        if (std::ranges::find(report.remarks, remark) == report.remarks.end())
            report.remarks.push_back(remark);
}

}  // namespace

double time_for_fwhm(double fwhm)
{
    return fwhm * fwhm / (16.0 * std::numbers::ln2);
}

double fwhm_for_time(double time)
{
    return std::sqrt(16.0 * std::numbers::ln2 * time);
}

FieldReport diffuse(const PolygonMesh& mesh, Eigen::MatrixXd& fields, const FlowOptions& options,
                    const FieldOptions& field_options, const FlowControl& control)
{
    require_for_fields(options, field_options);
    require_finite(fields, mesh.n_vertices());
    FieldReport report;
    Eigen::MatrixXd results = fields;
    const FlowOptions of_flow = options_of_flow(mesh, options, field_options);
    for (Group& group : group_columns(fields)) {
        FlowOptions own = of_flow;
        PolygonMesh surface = surface_of(mesh, group, own.laplacian, own.cut.labels);
        report.without_data = std::max(report.without_data, group.n_lacking);
        const bool measures = field_options.fwhm && !report.fwhm && options.steps > 0;
        own.steps = options.steps * (n_blocks(std::ssize(group.columns)) + (measures ? 1 : 0));
        Flow flow(surface, own, {}, control);
        ScaledFields scaled(fields, group, own.time_step);
        if (field_options.keep_edges)
            for (int step = 0; step < options.steps; ++step) {
                flow.keep_field_edges(scaled.in_units(), *field_options.keep_edges);
                flow.diffuse(scaled.values());
            }
        else
            flow.diffuse(scaled.values(), options.steps);
        scaled.write(group, results);
        if (measures) {
            Eigen::MatrixXd noise = white_noise(mesh.n_vertices());
            flow.diffuse(noise, options.steps);
            report.fwhm = fwhm_of_noise(surface, noise);
        }
        FlowReport of_group = flow.report();
        add_up(report.flow, of_group);
        report.flow = std::move(of_group);
        if (field_options.fill && group.n_lacking > 0 && group.n_lacking < mesh.n_vertices())
            extend(mesh, group, of_flow, control, results, report);
    }
    fields = std::move(results);
    report.remarks = report.flow.remarks;
    return report;
}

}  // namespace seamflow
