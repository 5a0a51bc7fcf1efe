#include "samples/figures/runner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "engine/mean_curvature_flow.h"
#include "engine/measure/displacement_meter.h"
#include "engine/measure/mesh_size.h"
#include "partition/errors.h"
#include "partition/metrics/roughness.h"
#include "partition/metrics/surface_distance.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/figures/experiments.h"
#include "samples/figures/mesh_files.h"
#include "samples/files/output_files.h"
#include "samples/page/page_html.h"
#include "samples/report/report_json.h"

namespace seamflow {

namespace {

LengthStatistics divided(const LengthStatistics& lengths, double unit)
{
    return {.mean = lengths.mean / unit, .rms = lengths.rms / unit, .max = lengths.max / unit};
}

/// An experiment while it runs.
class Run {
  public:
    Run(const Experiment& experiment, const Places& places, std::ostream& log)
        : experiment_(experiment)
        , places_(places)
        , log_(log)
        , input_(load(experiment.source, places.meshes))
        , topology_(make_topology(input_.mesh))
    {
        table_.figure = experiment.name;
        table_.mesh = input_.name;
        table_.vertices = input_.mesh.n_vertices();
        table_.is_theirs = input_.is_theirs;
        table_.flows = experiment.variants;
        table_.time_step = experiment.time_step;
        table_.steps = experiment.steps;
        table_.area = total_area(input_.mesh);
        table_.roughness = roughness(input_.mesh, input_.mesh.vertices);
        table_.theirs = experiment.theirs;
        if (!places_.out.empty())
            write_input(experiment, places_.out, input_);
        if (!places_.page.empty())
            page_mesh_ = std::make_shared<const PageMesh>(input_.mesh);
    }

    Table all()
    {
        log_ << experiment_.name << ": " << input_.name << ", " << input_.mesh.n_vertices() << " vertices\n";
        for (const Variant& variant : experiment_.variants)
            flow(variant);
        if (!page_flows_.empty())
            write_text(places_.page, page_html(fmt::format("Figure {}: {} ({})", experiment_.figure,
                                                           experiment_.heading, input_.name),
                                               page_flows_));
        return std::move(table_);
    }

  private:
    /// A flow that is added to the page, if there is one. It is compared if the undecomposed flow has been completed.
    class Shown {
      public:
        Shown(Run& run, const Variant& variant)
            : run_(run)
            , variant_(variant)
        {
            const auto reference = run.reference_.find(variant.laplacian);
            const auto steps = usize(run.experiment_.steps);
            if (variant.cut != CutKind::Uncut && reference != run.reference_.end() && reference->second.size() == steps)
                undecomposed_ = &reference->second;
            if (run.page_mesh_)
                flow_.emplace(run.page_mesh_, words_of(variant), variant.laplacian, run.experiment_.steps,
                              undecomposed_ != nullptr);
        }

        void add_step(const StepState& state)
        {
            if (!flow_)
                return;
            const Points* other = undecomposed_ == nullptr ? nullptr : &(*undecomposed_)[state.step - 1];
            flow_->add_step(state.step, state.positions, other);
            if (other != nullptr)
                distances_.push_back(vertex_distance(run_.input_.mesh, *other, state.positions));
        }

        void finish(FlowReport report)
        {
            if (!flow_)
                return;
            for (std::size_t k = 0; k < distances_.size(); ++k)
                report.steps[k].distance = distances_[k];
            std::istringstream words(command_of(run_.experiment_, variant_, run_.input_));
            std::string program;
            words >> program;
            const FlowOptions options = options_of(run_.experiment_, variant_, run_.input_);
            RunRecord record{.input = run_.input_.name,
                             .output = flow_->name(),
                             .arguments = {std::istream_iterator<std::string>(words), {}},
                             .scale = measure_scale(run_.input_.mesh),
                             .names = flow_names(options, static_cast<int>(report.steps.size()))};
            complete_record(record, report);
            flow_->finish(report, smooth_report_json(record, options, report));
            run_.page_flows_.push_back(std::move(*flow_));
        }

      private:
        Run& run_;
        const Variant& variant_;
        const std::vector<Points>* undecomposed_ = nullptr;
        std::optional<PageFlow> flow_;
        std::vector<VertexDistance> distances_;
    };

    void flow(const Variant& variant)
    {
        PolygonMesh mesh = input_.mesh;
        DisplacementMeter meter(input_.mesh, topology_);
        Points before = mesh.vertices;
        const std::size_t first = table_.rows.size();
        Shown shown(*this, variant);
        const auto measure = [&](const StepState& state) {
            meter.add_step(before, state.positions);
            before = state.positions;
            shown.add_step(state);
            if (variant.cut == CutKind::Uncut)
                reference_[variant.laplacian].push_back(state.positions);
            table_.rows.push_back(measured(variant, state, meter.total().drift.mean));
        };
        try {
            const FlowReport report = mean_curvature_flow(mesh, options_of(experiment_, variant, input_), measure);
            shown.finish(report);
            complete(variant, report, first);
        } catch (const ComputationError& error) {
            table_.remarks.push_back(words_of(variant) + ": " + error.what());
        }
        if (!places_.out.empty())
            write_state(experiment_, places_.out, input_, title_of(variant), mesh.vertices);
        report(title_of(variant), first);
    }

    /// Fills in what is known only at the end of a flow.
    void complete(const Variant& variant, const FlowReport& report, std::size_t first)
    {
        std::vector<double> p;
        for (const SubMeshReport& part : report.cut.sub_meshes)
            if (part.p > 0.0 && (variant.cut == CutKind::Metis || part.colour == 0))
                p.push_back(part.p);
        std::string range;
        if (!p.empty()) {
            const auto [low, high] = std::minmax_element(p.begin(), p.end());
            range = csv_number(*low) + (p.size() > 1 ? " to " + csv_number(*high) : "");
        }
        std::string leading;
        if (variant.cut == CutKind::Halves && report.cut.n_sub_meshes() == 2)
            leading = report.cut.sub_meshes[0].colour == 0 ? "0" : "1";
        for (std::size_t row = first; row < table_.rows.size(); ++row) {
            table_.rows[row].subdomains = report.cut.n_sub_meshes();
            table_.rows[row].p = range;
            table_.rows[row].leading = leading;
        }
    }

    /// The row of a state before the end of the flow.
    Row measured(const Variant& variant, const StepState& state, double drift) const
    {
        Row row;
        row.laplacian = variant.laplacian;
        row.conditions = conditions_of(variant);
        row.settings = name_of(variant.settings);
        row.step = state.step;
        row.seconds = state.report.seconds;
        row.roughness = roughness(input_.mesh, state.positions);
        if (variant.cut != CutKind::Uncut && variant.conditions == Conditions::AdaptedVentcell)
            row.q = csv_number(ventcell_q);
        row.subdomains = asked_for(variant);
        row.cut = cut_of(variant);
        row.command = command_of(experiment_, variant, input_);
        row.title = title_of(variant);
        row.words = words_of(variant);
        compare(row, state.positions, drift);
        if (variant.cut != CutKind::Halves)
            row.interface_length = std::nan("");
        return row;
    }

    /// Everything that is relative to the undecomposed flow.
    void compare(Row& row, const Points& positions, double drift) const
    {
        const auto reference = reference_.find(row.laplacian);
        if (reference == reference_.end() || reference->second.size() < usize(row.step)) {
            row.v = row.h = {.mean = std::nan(""), .rms = std::nan(""), .max = std::nan("")};
            row.drift = row.interface_length = std::nan("");
            return;
        }
        PolygonMesh from = input_.mesh;
        from.vertices = reference->second[row.step - 1];
        PolygonMesh to = input_.mesh;
        to.vertices = positions;
        const VertexDistance v = vertex_distance(from, from.vertices, positions);
        row.v = divided({.mean = v.mean, .rms = v.rms, .max = v.max}, v.mean_edge);
        row.h = divided(surface_distance(from, to), v.mean_edge);
        row.drift = drift / v.mean_edge;
        row.interface_length = interface_length(positions) / interface_length(from.vertices);
    }

    /// Sub-meshes; the result may differ.
    static Index asked_for(const Variant& variant)
    {
        if (variant.cut == CutKind::Uncut)
            return 1;
        return variant.cut == CutKind::Halves ? 2 : variant.subdomains;
    }

    [[nodiscard]] std::string cut_of(const Variant& variant) const
    {
        if (variant.cut == CutKind::Uncut)
            return "none";
        return variant.cut == CutKind::Halves ? input_.cut : "METIS, " + std::to_string(variant.subdomains) + " parts";
    }

    /// The length of the edges between the halves.
    [[nodiscard]] double interface_length(const Points& positions) const
    {
        double length = 0.0;
        for (Index h = 0; h < input_.mesh.n_corners(); ++h) {
            const Index twin = topology_.twin[h];
            if (twin < h || input_.labels[topology_.face_of[h]] == input_.labels[topology_.face_of[twin]])
                continue;
            const Index a = input_.mesh.face_vertices[h];
            const Index b = input_.mesh.face_vertices[topology_.next(input_.mesh, h)];
            length += (positions.row(a) - positions.row(b)).norm();
        }
        return length;
    }

    void report(const std::string& title, std::size_t first) const
    {
        log_ << "  " << title;
        if (first < table_.rows.size()) {
            const Row& last = table_.rows.back();
            log_ << ": step " << last.step << ", V_mean " << csv_number(last.v.mean) << ", V_max "
                 << csv_number(last.v.max) << ", H_mean " << csv_number(last.h.mean) << ", drift "
                 << csv_number(last.drift) << ", roughness " << csv_number(last.roughness.rms) << "°";
        }
        log_ << std::endl;
    }

    const Experiment& experiment_;
    const Places& places_;
    std::ostream& log_;
    FigureMesh input_;
    Topology topology_;
    Table table_;
    /// Per Laplacian and step, from step 1.
    std::map<Laplacian, std::vector<Points>> reference_;
    /// For the page with all flows, if there is one.
    std::shared_ptr<const PageMesh> page_mesh_;
    std::vector<PageFlow> page_flows_;
};

}  // namespace

Table run_experiment(const Experiment& experiment, const Places& places, std::ostream& log)
{
    return Run(experiment, places, log).all();
}

}  // namespace seamflow
