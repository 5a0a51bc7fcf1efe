#include "engine/diffuse.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/fields/field_columns.h"
#include "engine/fields/heat_equation.h"
#include "engine/fields/white_noise.h"
#include "engine/options/option_table.h"
#include "engine/setup/resolved_options.h"
#include "engine/tasks/workers.h"
#include "partition/large_arrays.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/surface_components.h"
#include "partition/text.h"
#include "partition/weld.h"
#include "partition/with_faces.h"
#include "solvers/laplacian/degenerate.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// The time of one step, in squared diagonals of the bounding box, after which K X = 0 up to rounding: only the
/// vertices with data then determine X.
constexpr double time_to_rest = 1e6;

/// The fraction of the wanted width by which the width that was reached may differ without a remark.
constexpr double most_missed_width = 0.1;
/// Kernels narrower than this many mean edge lengths are too narrow for a mesh.
constexpr double narrowest_width = 4.0;
/// The spectrum of fewer steps has no second moment (see time_for_fwhm).
constexpr int enough_steps = 2;

/// A mesh with the same vertices, and the faces whose vertices all have data, without unusable faces (see is_unusable).
/// @param labels one per face, or empty: those of the remaining faces are kept.
PolygonMesh surface_of(const PolygonMesh& mesh, const FieldGroup& group, Laplacian laplacian,
                       std::vector<Index>& labels)
{
    std::vector<Index> left;
    PolygonMesh surface = with_faces(mesh, [&](Index f) {
        const bool is_kept = std::ranges::all_of(mesh.face(f), [&](Index v) { return group.lacks[v] == 0; }) &&
                             !is_unusable(mesh, f, laplacian);
        if (is_kept && f < std::ssize(labels))
            left.push_back(labels[f]);
        return is_kept;
    });
    labels = std::move(left);
    return surface;
}

/// Treats vertices that are joined along seams (see weld) as one: a vertex without data that is joined with vertices
/// that have data gets the mean of these data.
class SeamsOfFields {
  public:
    SeamsOfFields(const PolygonMesh& mesh, const MotionOptions& motion)
        : mesh_(mesh)
    {
        if (motion.weld)
            weld_ = weld(mesh, make_topology(mesh), motion.weld->value);
    }

    /// Sets these means in the columns of a group, and marks the vertices that have got one as vertices with data.
    void complete(FieldGroup& group, Eigen::MatrixXd& fields) const
    {
        if (!weld_)
            return;
        const std::vector<std::uint8_t> lacked = group.lacks;
        // At representatives: the number of joined vertices that have data.
        std::vector<Index> n(lacked.size(), 0);
        for (std::size_t v = 0; v < lacked.size(); ++v)
            n[usize(weld_->representative[v])] += lacked[v] == 0 ? 1 : 0;
        for (const Eigen::Index c : group.columns) {
            std::vector<double> sums(lacked.size(), 0.0);
            for (std::size_t v = 0; v < lacked.size(); ++v)
                if (lacked[v] == 0)
                    sums[usize(weld_->representative[v])] += fields(static_cast<Eigen::Index>(v), c);
            for (std::size_t v = 0; v < lacked.size(); ++v)
                if (const std::size_t representative = usize(weld_->representative[v]);
                    lacked[v] != 0 && n[representative] > 0) {
                    fields(static_cast<Eigen::Index>(v), c) = sums[representative] / n[representative];
                    group.lacks[v] = 0;
                }
        }
    }

    /// #V: 1 if the vertex has data, or is connected by faces with a vertex that has data.
    [[nodiscard]] std::vector<std::uint8_t> reached_from_data(const FieldGroup& group, const Executor& exec) const
    {
        const SurfaceComponents components = surface_components(weld_ ? weld_->mesh : mesh_, exec);
        const auto component_of = [&](Index v) { return components.of_vertex[weld_ ? weld_->representative[v] : v]; };
        std::vector<std::uint8_t> has_data(usize(components.count()), 0);
        std::vector<std::uint8_t> reached(group.lacks.size(), 0);
        for (Index v = 0; v < mesh_.n_vertices(); ++v)
            if (group.lacks[v] == 0) {
                reached[v] = 1;
                if (component_of(v) >= 0)
                    has_data[component_of(v)] = 1;
            }
        for (Index v = 0; v < mesh_.n_vertices(); ++v)
            if (component_of(v) >= 0)
                reached[v] = has_data[component_of(v)];
        return reached;
    }

  private:
    const PolygonMesh& mesh_;
    std::optional<Weld> weld_;
};

/// The faces over which data are extended. Faces are left out at vertices without data that would be fixed, because
/// they have no row in the Laplacian or because sheets merely touch there: they would act like vertices with data.
PolygonMesh surface_for_extension(const PolygonMesh& mesh, const FieldGroup& group, Laplacian laplacian)
{
    const PolygonMesh sound = with_faces(mesh, [&](Index f) { return !is_unusable(mesh, f, laplacian); });
    Topology topology = make_topology(sound);
    free_junctions(sound, topology, run_serially);
    free_boundary(topology);
    std::vector<std::uint8_t> is_fixed(usize(mesh.n_vertices()), 0);
    for (const Index v : vertices_without_row(sound, topology, laplacian))
        is_fixed[v] = group.lacks[v];
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::NonManifold)
            is_fixed[v] = group.lacks[v];
    return with_faces(
        sound, [&](Index f) { return std::ranges::none_of(sound.face(f), [&](Index v) { return is_fixed[v] != 0; }); });
}

/// The number of solutions from which on one factorisation of the whole surface pays, with which many columns are
/// solved for at a time (measured: see samples/benchmark/speed.md); and the most vertices for which this is done, whose
/// factor takes about 1 GB.
constexpr Eigen::Index enough_solutions = 64;
constexpr Index most_vertices_of_factor = 1'500'000;

/// Chooses one factorisation of the whole surface, with which many columns are solved for at a time, if the options
/// leave the approach open and it pays.
/// @param n_solutions the number of solutions with one factorisation. @param options receive the choice.
/// @returns whether the whole surface is factorised.
bool choose_whole_factorisation(const PolygonMesh& surface, Eigen::Index n_solutions, const FlowControl& control,
                                FlowOptions& options)
{
    if (options.accuracy.approach != Approach::Automatic || control.ranks != nullptr ||
        options.resources.memory_limit || !first_set(options, concern::sub_meshes | concern::factors).empty() ||
        !filter_of(options).is_plain() || n_solutions < enough_solutions ||
        surface.n_vertices() > most_vertices_of_factor)
        return false;
    options.accuracy.approach = Approach::Undecomposed;
    options.accuracy.tolerance.reset();
    return true;
}

/// A copy in large pages, where the system has them.
Eigen::MatrixXd copy_of(const Eigen::MatrixXd& fields, const Executor& exec)
{
    Eigen::MatrixXd copy;
    resize_large(copy, fields.rows(), fields.cols());
    for_each(exec, static_cast<Index>(fields.cols()), [&](Index c) { copy.col(c) = fields.col(c); });
    return copy;
}

/// The means of columns over the vertices with data.
Eigen::RowVectorXd means_of(const Eigen::MatrixXd& fields, const FieldGroup& group)
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

/// Computes the harmonic extension of the data by one long step.
/// @param group in: its `lacks` is 0 at vertices with data. Out: `lacks` is 0 only at vertices that the step gave data,
/// and 1 at all others, also at those that had data.
/// @param fields #V by n: the columns of the group receive the extension.
/// @param filled #V: receives 1 at vertices that got data. @returns the report of that step.
FlowReport extend(const PolygonMesh& mesh, FieldGroup& group, const FlowOptions& options, Weights weights,
                  const FlowControl& control, const Executor& exec, Eigen::MatrixXd& fields,
                  std::vector<std::uint8_t>& filled)
{
    const std::vector<std::uint8_t> lacked_first = group.lacks;
    PolygonMesh surface = surface_for_extension(mesh, group, options.laplacian);
    const SeamsOfFields seams(surface, options.motion);
    seams.complete(group, fields);
    const std::vector<std::uint8_t> reached = seams.reached_from_data(group, exec);
    FlowOptions own = options;
    own.filter = Filter::Diffusion;
    own.order.reset();
    // The solver is chosen for this many steps of three columns each.
    own.steps = n_blocks(std::ssize(group.columns));
    own.accuracy.approach = Approach::Automatic;
    own.accuracy.tolerance = default_field_tolerance;
    own.cut = {};
    own.motion.boundary = Boundary::Free;
    own.motion.junctions = Junctions::Flow;
    own.motion.fixed_vertices.clear();
    const BoundingBox box = box_of_faces(mesh, exec);
    own.time_step = time_to_rest * (box.high - box.low).squaredNorm();
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (group.lacks[v] == 0 || reached[v] == 0)
            own.motion.fixed_vertices.push_back(v);
    // The means are subtracted first, because M pulls towards 0.
    const Eigen::RowVectorXd means = means_of(fields, group);
    choose_whole_factorisation(surface, std::ssize(group.columns), control, own);
    HeatEquation heat(std::move(surface), own, weights, control);
    const std::vector<ValueRange> ranges = ranges_of(fields, group, exec);
    std::vector<ValueRange> about_means = ranges;
    for (std::size_t c = 0; c < ranges.size(); ++c)
        about_means[c] = {ranges[c].least - means[group.columns[c]], ranges[c].most - means[group.columns[c]]};
    ScaledFields scaled(fields(Eigen::all, group.columns).rowwise() - means(group.columns), group, about_means,
                        own.time_step, exec);
    heat.take_steps(scaled.values());
    const std::vector<std::uint8_t> lacked = group.lacks;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        group.lacks[v] = lacked[v] != 0 && reached[v] != 0 ? 0 : 1;
    const Eigen::MatrixXd extended = scaled.take(group, exec);
    for (std::size_t i = 0; i < group.columns.size(); ++i)
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (const Eigen::Index c = group.columns[i]; group.lacks[v] == 0)
                fields(v, c) = extended(v, static_cast<Eigen::Index>(i)) + means[c];
    if (weights != Weights::OfLaplacian)
        keep_within(ranges, group, fields, exec);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (lacked_first[v] != 0 && !std::isnan(fields(v, group.columns.front())))
            filled[v] = 1;
    return heat.report();
}

/// Adds the report on filling to the report on the steps, without repeating its remarks. The choices made for filling
/// are not reported.
void add_filling(const FlowReport& of_fill, FlowReport& of_group, std::vector<Remark>& remarks)
{
    FlowReport counted = of_fill;
    counted.choices.clear();
    add_up(counted, of_group);
    for (const Remark& remark : of_fill.remarks)
        if (std::ranges::find(of_group.remarks, remark) == of_group.remarks.end())
            remarks.push_back({remark.kind, remark.numbers, {"Filling: " + remark.wording.text}});
}

/// Adds a remark if the width that was reached is far from the wanted one.
void remark_on_width(double wanted, std::optional<double> reached, const PolygonMesh& surface,
                     const FlowOptions& options, std::vector<Remark>& remarks)
{
    if (reached && std::abs(*reached - wanted) <= most_missed_width * wanted)
        return;
    const char* reason = "it is wide for this surface, or edges differ much in length";
    if (wanted < narrowest_width * mean_edge_length(surface))
        reason = "it is less than four mean edge lengths, too narrow for this mesh";
    else if (!filter_of(options).is_plain())
        reason = "it is the width of the filter diffusion of order 1";
    else if (options.steps < enough_steps)
        reason = "more steps come nearer";
    else if (traits_of(options.laplacian).reach == Reach::Edges)
        reason = "what this Laplacian does depends on the faces";
    Remark::Numbers numbers{{"asked", wanted}};
    if (reached)
        numbers.emplace_back("reached", *reached);
    remarks.push_back(
        {"missed width",
         numbers,
         {fmt::format("A width of {:.3g} was asked for, {}: {}.", wanted,
                      reached ? fmt::format("{:.3g} was reached", *reached) : "none can be measured", reason)}});
}

/// Adds a remark on the vertices of a column that have no data at the end.
void remark_on_unfilled(const Eigen::VectorXd& filled, std::vector<Remark>& remarks)
{
    if (const auto n = filled.array().isNaN().count(); n > 0)
        remarks.push_back({"not filled",
                           {{"vertices", n}},
                           {fmt::format("Filling: {} {} without data, because faces connect {} with no vertex that has "
                                        "any.",
                                        counted(static_cast<std::uint64_t>(n), "vertex", "vertices"),
                                        n == 1 ? "stays" : "stay", n == 1 ? "it" : "them")}});
}

/// Takes steps with the columns of a group. With keep_edges, K is weighed anew before each step.
void take_steps(HeatEquation& heat, const FieldOptions& field_options, int steps, ScaledFields& scaled)
{
    if (!field_options.keep_edges)
        return heat.take_steps(scaled.values(), steps);
    for (int step = 0; step < steps; ++step) {
        heat.keep_field_edges(scaled.in_units(), *field_options.keep_edges);
        heat.take_steps(scaled.values());
    }
}

/// Measures the width of the kernel by the same steps on white noise, which do not count as steps of the fields.
/// @param wanted in length. @param of_group gets a remark, and the time.
/// @returns nothing if the width cannot be measured.
std::optional<double> measure_width(HeatEquation& heat, double wanted, const FlowOptions& options, FlowReport& of_group)
{
    // The width of a few columns on a small surface is a matter of chance.
    constexpr Index values = 200'000;
    constexpr Index fewest = 3;
    constexpr Index most = 24;
    const Index n = heat.surface().n_vertices();
    Eigen::MatrixXd noise = white_noise(n, std::clamp(values / std::max(n, Index{1}), fewest, most));
    heat.take_steps(noise, options.steps);
    const std::optional<double> fwhm = fwhm_of_noise(heat.surface(), noise);
    remark_on_width(wanted, fwhm, heat.surface(), options, of_group.remarks);
    of_group.seconds = heat.report().seconds;
    return fwhm;
}

}  // namespace

FieldReport diffuse(const PolygonMesh& mesh, Eigen::MatrixXd& fields, const FlowOptions& options,
                    const FieldOptions& field_options, const FlowControl& control)
{
    require_for_fields(options, field_options);
    require_fields_of(mesh.n_vertices(), fields);
    FieldReport report;
    Workers workers(options.resources.threads);
    const Executor exec = workers.exec();
    Eigen::MatrixXd results = copy_of(fields, exec);
    LengthScale scale(mesh, exec);
    const FieldOptions of_fields = resolved(field_options, scale);
    const FlowOptions of_flow = resolved(flow_for_fields(options, of_fields), mesh);
    const Weights weights = weights_for_fields(field_options);
    // With keep_edges, K changes between steps.
    FlowControl own_control = control;
    if (field_options.keep_edges)
        own_control.ranks = nullptr;
    std::vector<FieldGroup> groups = group_columns(fields);
    std::vector<std::vector<Remark>> remarks;
    // #V: 1 at vertices where some column has no data before; and at vertices where some column got data.
    std::vector<std::uint8_t> lacking(usize(mesh.n_vertices()), 0);
    std::vector<std::uint8_t> filled = lacking;
    for (FieldGroup& group : groups) {
        FlowOptions own = of_flow;
        PolygonMesh surface = surface_of(mesh, group, own.laplacian, own.cut.labels);
        std::ranges::transform(lacking, group.lacks, lacking.begin(), std::bit_or<>());
        const bool measures = field_options.fwhm && !report.fwhm && options.steps > 0;
        own.steps = options.steps * (n_blocks(std::ssize(group.columns)) + (measures ? 1 : 0));
        const bool is_whole = choose_whole_factorisation(
            surface, std::ssize(group.columns) * (field_options.keep_edges ? 1 : options.steps), own_control, own);
        HeatEquation heat(std::move(surface), own, weights, own_control);
        const std::vector<ValueRange> ranges = ranges_of(fields, group, exec);
        const bool has_all = std::ssize(group.columns) == results.cols();
        ScaledFields scaled(has_all ? std::move(results) : Eigen::MatrixXd(results(Eigen::all, group.columns)), group,
                            ranges, own.time_step, exec);
        take_steps(heat, field_options, options.steps, scaled);
        if (has_all)
            results = scaled.take(group, exec);
        else
            results(Eigen::all, group.columns) = scaled.take(group, exec);
        if (filter_of(own).is_plain() && weights != Weights::OfLaplacian)
            keep_within(ranges, group, results, exec);
        FlowReport of_group = heat.report();
        if (is_whole)
            of_group.choices.push_back(
                {"approach",
                 {},
                 {"The whole mesh is solved at once by one factorisation: that is fastest for so many columns."}});
        if (measures)
            report.fwhm = measure_width(heat, of_fields.fwhm->value, of_flow, of_group);
        remarks.push_back(of_group.remarks);
        if (field_options.fill && group.n_lacking > 0 && group.n_lacking < mesh.n_vertices()) {
            const FlowReport of_fill = extend(mesh, group, of_flow, weights, control, exec, results, filled);
            add_filling(of_fill, of_group, remarks.back());
        }
        if (field_options.fill)
            remark_on_unfilled(results.col(group.columns.front()), remarks.back());
        add_up(report.flow, of_group);
        report.flow = std::move(of_group);
    }
    report.without_data = static_cast<Index>(std::ranges::count(lacking, 1));
    report.filled = static_cast<Index>(std::ranges::count(filled, 1));
    fields = std::move(results);
    report.remarks = remarks_on(groups, remarks, field_options.names);
    report.flow.remarks = report.remarks;
    return report;
}

}  // namespace seamflow
