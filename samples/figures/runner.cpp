#include "samples/figures/runner.h"

#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <utility>

#include "engine/displacement_meter.h"
#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/surface_distance.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/figures/figure_page.h"
#include "samples/figures/picture.h"
#include "samples/figures/roughness.h"

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
        table_.as_authors = input_.authors && input_.authors->p;
        table_.steps = experiment.steps;
        table_.roughness = roughness(input_.mesh, topology_, input_.mesh.vertices);
        picture("input", input_.mesh.vertices);
        if (!places_.page.empty())
            page_.emplace(input_);
    }

    Table all()
    {
        log_ << experiment_.name << ": " << input_.name << ", " << input_.mesh.n_vertices() << " vertices\n";
        for (const Variant& variant : experiment_.variants)
            flow(variant);
        if (page_)
            page_->write(places_.page, table_.figure);
        return std::move(table_);
    }

  private:
    /// A flow on its way to the page, if there is one. It is compared if the undecomposed flow has come to its end.
    class Shown {
      public:
        Shown(Run& run, const Variant& variant)
            : run_(run)
            , laplacian_(variant.laplacian)
        {
            const auto reference = run.reference_.find(variant.laplacian);
            const auto steps = at(run.experiment_.steps);
            if (variant.pieces != Pieces::One && reference != run.reference_.end() && reference->second.size() == steps)
                undecomposed_ = &reference->second;
            if (run.page_)
                flow_ =
                    run.page_->begin(run.title(variant), laplacian_, run.experiment_.steps, undecomposed_ != nullptr);
        }

        void add_step(const StepState& state)
        {
            if (!flow_)
                return;
            const Points* other = undecomposed_ == nullptr ? nullptr : &(*undecomposed_)[at(state.step) - 1];
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
            run_.page_->add(std::move(*flow_), report, laplacian_);
        }

      private:
        Run& run_;
        Laplacian laplacian_;
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
            if (variant.pieces == Pieces::One)
                reference_[variant.laplacian].push_back(state.positions);
            table_.rows.push_back(measured(variant, state, meter.total().drift.mean));
        };
        Index subdomains = 1;
        try {
            const FlowReport report = mean_curvature_flow(mesh, options_of(experiment_, variant, input_), measure);
            subdomains = report.subdomains;
            shown.finish(report);
        } catch (const ComputationError& error) {
            table_.remarks.push_back(title(variant) + ": " + error.what());
        }
        for (std::size_t row = first; row < table_.rows.size(); ++row)
            table_.rows[row].subdomains = subdomains;
        picture(title(variant), mesh.vertices);
        report(title(variant), first);
    }

    /// What is known of a state, but for the number of sub-meshes.
    Row measured(const Variant& variant, const StepState& state, double drift) const
    {
        Row row;
        row.figure = table_.figure;
        row.mesh = table_.mesh;
        row.vertices = input_.mesh.n_vertices();
        row.laplacian = variant.laplacian;
        row.conditions = conditions_of(variant);
        row.settings = name_of(variant.settings);
        row.step = state.step;
        row.seconds = state.report.seconds;
        row.roughness = roughness(input_.mesh, topology_, state.positions);
        compare(row, state.positions, drift);
        return row;
    }

    /// Everything that is relative to the undecomposed flow.
    void compare(Row& row, const Points& positions, double drift) const
    {
        const auto reference = reference_.find(row.laplacian);
        if (reference == reference_.end() || reference->second.size() < at(row.step)) {
            row.v = row.h = {.mean = std::nan(""), .rms = std::nan(""), .max = std::nan("")};
            row.drift = std::nan("");
            return;
        }
        PolygonMesh from = input_.mesh;
        from.vertices = reference->second[at(row.step) - 1];
        PolygonMesh to = input_.mesh;
        to.vertices = positions;
        const VertexDistance v = vertex_distance(from, from.vertices, positions);
        row.v = divided({.mean = v.mean, .rms = v.rms, .max = v.max}, v.mean_edge);
        row.h = divided(surface_distance(from, to), v.mean_edge);
        row.drift = drift / v.mean_edge;
    }

    /// Of a flow: "fujiwara-schwarz-2", say.
    [[nodiscard]] std::string title(const Variant& variant) const
    {
        std::string text(name_of(variant.laplacian));
        text.append("-").append(conditions_of(variant));
        if (variant.pieces == Pieces::Metis)
            text.append("-").append(std::to_string(variant.subdomains)).append("-").append(name_of(variant.settings));
        return text;
    }

    void picture(const std::string& title, const Points& positions) const
    {
        if (!places_.pictures.empty())
            write_picture(places_.pictures / (std::string(experiment_.name) + "-" + title + ".ply"), input_.mesh,
                          positions);
    }

    void report(const std::string& title, std::size_t first) const
    {
        log_ << "  " << title;
        if (first < table_.rows.size()) {
            const Row& last = table_.rows.back();
            log_ << ": step " << last.step << ", V_mean " << csv_number(last.v.mean) << ", V_max "
                 << csv_number(last.v.max) << ", H_mean " << csv_number(last.h.mean) << ", drift "
                 << csv_number(last.drift) << ", roughness " << csv_number(last.roughness);
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
    std::optional<FigurePage> page_;
};

}  // namespace

Table run_experiment(const Experiment& experiment, const Places& places, std::ostream& log)
{
    return Run(experiment, places, log).all();
}

}  // namespace seamflow
