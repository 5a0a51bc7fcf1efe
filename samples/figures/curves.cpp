#include "samples/figures/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "samples/figures/measured.h"
#include "samples/figures/plot.h"

namespace seamflow {

namespace {

constexpr int most_in_a_row = 3;

struct Curve {
    const char* name;
    Quantity what;
    const char* colour;
    const char* dashes;
};

constexpr const char* colour_of_v = "#2f78b7";
constexpr const char* colour_of_h = "#c8702a";
constexpr std::array curves{
    Curve{"V_max", v_max, colour_of_v, "1 3"}, Curve{"V_RMS", v_rms, colour_of_v, "6 3"},
    Curve{"V_mean", v_mean, colour_of_v, ""},  Curve{"H_max", h_max, colour_of_h, "1 3"},
    Curve{"H_RMS", h_rms, colour_of_h, "6 3"}, Curve{"H_mean", h_mean, colour_of_h, ""},
};

/// The steps of one flow.
using Rows = std::vector<const Row*>;

/// The decomposed flows.
std::vector<Rows> decomposed_flows(const Table& table)
{
    std::vector<Rows> flows;
    for (const Row& row : table.rows) {
        if (row.conditions == "undecomposed")
            continue;
        if (flows.empty() || flows.back().front()->title != row.title)
            flows.emplace_back();
        flows.back().push_back(&row);
    }
    return flows;
}

/// The authors' results after the last step.
PlottedCurve marks(const Row& flow, int steps, const Experiment& experiment)
{
    PlottedCurve marks{.name = "the authors' V_mean and V_max", .colour = "#b02a50", .is_mark = true};
    for (const AuthorsDistances& one : experiment.theirs)
        if (is_of(flow, one))
            marks.points = {{steps, one.v_mean}, {steps, one.v_max}};
    return marks;
}

PlotPanel panel_of(const Rows& flow, int steps)
{
    PlotPanel panel{.title = flow.front()->words, .x_title = "step", .x_from = 0.5, .x_to = steps + 0.5};
    for (int step = 1; step <= steps; step += 1 + steps / 12)
        panel.x_ticks.push_back(step);
    for (const Curve& curve : curves) {
        PlottedCurve plotted{.name = curve.name, .colour = curve.colour, .dashes = curve.dashes};
        for (const Row* row : flow)
            plotted.points.emplace_back(row->step, curve.what(*row));
        panel.curves.push_back(std::move(plotted));
    }
    return panel;
}

/// A way of taking steps in flows with many sub-meshes.
struct Way {
    const char* words;
    Settings settings;
    Conditions conditions;
};

constexpr std::array ways{Way{"the paper's method", Settings::Plain, Conditions::AdaptedRobin},
                          Way{"the library's defaults", Settings::Default, Conditions::AdaptedRobin},
                          Way{"alternating Schwarz", Settings::Plain, Conditions::Schwarz}};

struct LineColour {
    Laplacian laplacian;
    const char* colour;
};

constexpr std::array line_colours{LineColour{Laplacian::Fujiwara, "#2f78b7"},
                                  LineColour{Laplacian::AlexaWardetzky, "#2c8a57"},
                                  LineColour{Laplacian::PtackovaVelho, "#c8702a"}};

/// V_mean and V_max of the flows that take steps in that way, each Laplacian in its colour.
/// @param x_of the abscissa for a number of sub-meshes.
void add_curves(const Table& table, const Way& way, const std::function<double(Index)>& x_of,
                std::vector<PlottedCurve>& plotted)
{
    for (const LineColour& colour : line_colours) {
        PlottedCurve mean{.name = symbol_of(colour.laplacian) + ", V_mean", .colour = colour.colour};
        PlottedCurve largest{.name = symbol_of(colour.laplacian) + ", V_max", .colour = colour.colour, .dashes = "1 3"};
        for (const Variant& variant : table.flows) {
            if (variant.cut != CutKind::Metis || variant.laplacian != colour.laplacian ||
                variant.settings != way.settings || variant.conditions != way.conditions)
                continue;
            const Row* last = table.find(variant, table.steps);
            const double x = x_of(last == nullptr ? variant.subdomains : last->subdomains);
            mean.points.emplace_back(x, last == nullptr ? std::nan("") : last->v.mean);
            largest.points.emplace_back(x, last == nullptr ? std::nan("") : last->v.max);
        }
        if (mean.points.empty())
            continue;
        plotted.push_back(std::move(mean));
        plotted.push_back(std::move(largest));
    }
}

std::vector<PlottedCurve> legend_of_many()
{
    std::vector<PlottedCurve> legend;
    for (const char* const dashes : {"", "1 3"})
        for (const LineColour& colour : line_colours)
            legend.push_back({.name = symbol_of(colour.laplacian) + (*dashes == '\0' ? ", V_mean" : ", V_max"),
                              .colour = colour.colour,
                              .dashes = dashes});
    return legend;
}

constexpr const char* note_of_many =
    "From the undecomposed flow after the last step, in mean edge lengths; a gap where a flow ended early.";

}  // namespace

std::string curves_svg(const Table& table, const Experiment& experiment)
{
    const std::vector<Rows> flows = decomposed_flows(table);
    if (table.steps < 2 || flows.empty())
        return {};
    std::vector<PlotPanel> panels;
    for (const Rows& flow : flows)
        panels.push_back(panel_of(flow, table.steps));
    std::vector<PlottedCurve> legend = panels.front().curves;
    if (table.is_theirs && !experiment.theirs.empty()) {
        for (std::size_t k = 0; k < flows.size(); ++k)
            panels[k].curves.push_back(marks(*flows[k].front(), table.steps, experiment));
        legend.push_back(panels.front().curves.back());
    }
    const auto n = static_cast<int>(panels.size());
    return plot_svg(panels, n <= most_in_a_row ? n : (n + 1) / 2, legend, "in mean edge lengths");
}

std::string curves_of_many(const std::vector<Table>& tables)
{
    std::vector<PlotPanel> panels;
    for (const Table& table : tables)
        for (const Way& way : ways) {
            PlotPanel panel{.title = table.figure + ", " + way.words,
                            .x_title = "sub-meshes",
                            .logarithmic = true,
                            .x_from = 1.7,
                            .x_to = 38.0,
                            .x_ticks = {2, 4, 8, 16, 32}};
            add_curves(
                table, way, [](Index n) { return static_cast<double>(n); }, panel.curves);
            if (!panel.curves.empty())
                panels.push_back(std::move(panel));
        }
    return plot_svg(panels, most_in_a_row, legend_of_many(), note_of_many);
}

std::string curves_over_width(const std::vector<Table>& tables)
{
    std::vector<PlotPanel> panels;
    for (const Way& way : ways) {
        PlotPanel panel{.title = std::string("all meshes, ") + way.words,
                        .x_title = "√dt / width of a sub-mesh",
                        .logarithmic = true,
                        .x_from = 0.003,
                        .x_to = 2.0,
                        .x_ticks = {0.01, 0.1, 1.0}};
        for (const Table& table : tables)
            add_curves(
                table, way, [&](Index n) { return std::sqrt(table.time_step * static_cast<double>(n) / table.area); },
                panel.curves);
        if (!panel.curves.empty())
            panels.push_back(std::move(panel));
    }
    return plot_svg(panels, most_in_a_row, legend_of_many(), note_of_many);
}

}  // namespace seamflow
