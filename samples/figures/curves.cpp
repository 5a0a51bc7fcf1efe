#include "samples/figures/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "samples/figures/measured.h"

namespace seamflow {

namespace {

constexpr double panel_width = 320.0;
constexpr double plot_left = 46.0;
constexpr double plot_right = 308.0;
constexpr double plot_top = 30.0;
constexpr double plot_bottom = 240.0;
constexpr double panel_height = 280.0;
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

/// A number of pixels.
std::string pixels(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

std::string line(double x1, double y1, double x2, double y2, const char* colour)
{
    return "<line x1=\"" + pixels(x1) + "\" y1=\"" + pixels(y1) + "\" x2=\"" + pixels(x2) + "\" y2=\"" + pixels(y2) +
           "\" stroke=\"" + colour + "\"/>\n";
}

std::string words(double x, double y, const char* anchor, const std::string& text)
{
    return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + anchor + "\">" + text + "</text>\n";
}

/// The steps of one flow.
using Panel = std::vector<const Row*>;

/// From and to which power of ten all curves and the authors' numbers reach.
std::pair<int, int> powers_of_ten(const std::vector<Panel>& panels, const std::vector<AuthorsDistances>& theirs)
{
    double low = 1.0;
    double high = 1.0;
    for (const AuthorsDistances& one : theirs) {
        low = std::min(low, one.v_mean);
        high = std::max(high, std::isfinite(one.v_max) ? one.v_max : one.v_mean);
    }
    for (const Panel& panel : panels)
        for (const Row* row : panel)
            for (const Curve& curve : curves)
                if (const double value = curve.what(*row); std::isfinite(value) && value > 0.0) {
                    low = std::min(low, value);
                    high = std::max(high, value);
                }
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    return {static_cast<int>(std::floor(std::log10(low))), std::max(last, 1)};
}

/// One panel, drawn with its corner at the origin.
class Drawing {
  public:
    Drawing(const Panel& panel, int steps, std::pair<int, int> powers)
        : panel_(panel)
        , steps_(steps)
        , powers_(powers)
    {
    }

    [[nodiscard]] std::string svg() const
    {
        std::string text = words(plot_left, 18.0, "start", panel_.front()->words) + axes();
        for (const Curve& curve : curves)
            text += drawn(curve);
        return text;
    }

    /// A diamond at the last step.
    [[nodiscard]] std::string mark(double value) const
    {
        const std::string x = pixels(x_of(steps_));
        const std::string y = pixels(y_of(value));
        return std::isfinite(value)
                   ? "<path d=\"M" + x + "," + y +
                         "m-5,0l5,-5l5,5l-5,5z\" fill=\"none\" stroke=\"#b02a50\" stroke-width=\"1.5\"/>\n"
                   : "";
    }

  private:
    [[nodiscard]] double x_of(double step) const
    {
        return plot_left + (step - 0.5) / steps_ * (plot_right - plot_left);
    }

    [[nodiscard]] double y_of(double value) const
    {
        const double part = (std::log10(value) - powers_.first) / (powers_.second - powers_.first);
        return plot_bottom - part * (plot_bottom - plot_top);
    }

    [[nodiscard]] std::string axes() const
    {
        std::string text;
        const int apart = 1 + (powers_.second - powers_.first) / 8;
        for (int power = powers_.first; power <= powers_.second; power += apart) {
            const double y = y_of(std::pow(10.0, power));
            text += line(plot_left, y, plot_right, y, "#9aa3ad55");
            text += words(plot_left - 5.0, y + 4.0, "end", csv_number(std::pow(10.0, power)));
        }
        text += line(plot_left, plot_bottom, plot_right, plot_bottom, "#8a939d");
        for (int step = 1; step <= steps_; step += 1 + steps_ / 12)
            text += words(x_of(step), plot_bottom + 16.0, "middle", std::to_string(step));
        return text + words((plot_left + plot_right) / 2.0, plot_bottom + 32.0, "middle", "step");
    }

    [[nodiscard]] std::string drawn(const Curve& curve) const
    {
        std::string path;
        bool pen_is_down = false;
        for (const Row* row : panel_) {
            const double value = curve.what(*row);
            if (std::isfinite(value) && value > 0.0)
                path.append(pen_is_down ? "L" : "M")
                    .append(pixels(x_of(row->step)))
                    .append(",")
                    .append(pixels(y_of(value)));
            pen_is_down = std::isfinite(value) && value > 0.0;
        }
        return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + curve.colour + "\" stroke-width=\"1.8\"" +
               " stroke-linecap=\"round\" stroke-dasharray=\"" + curve.dashes + "\"><title>" + curve.name +
               "</title></path>\n";
    }

    const Panel& panel_;
    int steps_;
    std::pair<int, int> powers_;
};

/// The decomposed flows.
std::vector<Panel> panels_of(const Table& table)
{
    std::vector<Panel> panels;
    for (const Row& row : table.rows) {
        if (row.conditions == "undecomposed")
            continue;
        if (panels.empty() || panels.back().front()->title != row.title)
            panels.emplace_back();
        panels.back().push_back(&row);
    }
    return panels;
}

std::string marks(const Panel& panel, const Drawing& drawing, const Experiment& experiment)
{
    std::string text;
    for (const AuthorsDistances& one : experiment.theirs)
        if (is_of(*panel.front(), one))
            text += drawing.mark(one.v_mean) + drawing.mark(one.v_max);
    return text;
}

/// In two rows: V, H.
std::string legend(double y, bool with_marks)
{
    std::string text;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const double x = plot_left + 92.0 * static_cast<double>(k % 3);
        const double here = y + (k < 3 ? 0.0 : 20.0);
        text += "<line x1=\"" + pixels(x) + "\" y1=\"" + pixels(here) + "\" x2=\"" + pixels(x + 28.0) + "\" y2=\"" +
                pixels(here) + "\" stroke=\"" + curves[k].colour +
                "\" stroke-width=\"1.8\" stroke-linecap=\"round\" stroke-dasharray=\"" + curves[k].dashes + "\"/>\n" +
                words(x + 34.0, here + 4.0, "start", curves[k].name);
    }
    const double x = plot_left + 300.0;
    if (with_marks)
        text += words(x, y + 4.0, "start", "◇ the authors' V_mean and V_max");
    return text + words(x, y + (with_marks ? 24.0 : 4.0), "start", "in mean edge lengths");
}

}  // namespace

std::string curves_svg(const Table& table, const Experiment& experiment)
{
    const std::vector<Panel> panels = panels_of(table);
    if (table.steps < 2 || panels.empty())
        return {};
    const auto powers = powers_of_ten(panels, table.is_theirs ? experiment.theirs : std::vector<AuthorsDistances>{});
    const auto n = static_cast<int>(panels.size());
    const int columns = n <= most_in_a_row ? n : (n + 1) / 2;
    const int rows = (n + columns - 1) / columns;
    const double width = panel_width * std::max(columns, 2);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + pixels(width) + " " +
                       pixels(rows * panel_height + 44.0) + "\" width=\"" + pixels(width) +
                       "\" font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#6b757f\">\n";
    for (int k = 0; k < n; ++k) {
        const Panel& panel = panels[static_cast<std::size_t>(k)];
        const Drawing drawing(panel, table.steps, powers);
        text += "<g transform=\"translate(" + pixels(panel_width * (k % columns)) + "," +
                pixels(panel_height * (k / columns)) + ")\">\n" + drawing.svg();
        if (table.is_theirs)
            text += marks(panel, drawing, experiment);
        text += "</g>\n";
    }
    return text + legend(rows * panel_height + 14.0, table.is_theirs && !experiment.theirs.empty()) + "</svg>\n";
}

}  // namespace seamflow
