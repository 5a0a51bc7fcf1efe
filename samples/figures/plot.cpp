#include "samples/figures/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samples/figures/table.h"

namespace seamflow {

namespace {

constexpr double panel_width = 320.0;
constexpr double plot_left = 46.0;
constexpr double plot_right = 308.0;
constexpr double plot_top = 30.0;
constexpr double plot_bottom = 240.0;
constexpr double panel_height = 280.0;
constexpr double legend_width = 150.0;

bool can_be_drawn(double value)
{
    return std::isfinite(value) && value > 0.0;
}

std::string line(double x1, double y1, double x2, double y2, const std::string& stroke)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2,
                       y2, stroke);
}

std::string words(double x, double y, const char* anchor, const std::string& text)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

/// The attributes of a curve's line.
std::string stroke_of(const PlottedCurve& curve)
{
    return fmt::format("{}\" stroke-width=\"1.8\" stroke-linecap=\"round\" stroke-dasharray=\"{}", curve.colour,
                       curve.dashes);
}

std::string diamond(double x, double y, const std::string& colour)
{
    return fmt::format("<path d=\"M{:.1f},{:.1f}m-5,0l5,-5l5,5l-5,5z\" fill=\"none\" stroke=\"{}\" "
                       "stroke-width=\"1.5\"/>\n",
                       x, y, colour);
}

/// The lowest and highest powers of ten of all curves.
std::pair<int, int> powers_of_ten(const std::vector<PlotPanel>& panels)
{
    double low = 1.0;
    double high = 1.0;
    for (const PlotPanel& panel : panels)
        for (const PlottedCurve& curve : panel.curves)
            for (const auto& [x, y] : curve.points)
                if (can_be_drawn(y)) {
                    low = std::min(low, y);
                    high = std::max(high, y);
                }
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    return {static_cast<int>(std::floor(std::log10(low))), std::max(last, 1)};
}

/// One panel, drawn with its corner at the origin.
class Drawing {
  public:
    Drawing(const PlotPanel& panel, std::pair<int, int> powers)
        : panel_(panel)
        , powers_(powers)
    {
    }

    [[nodiscard]] std::string svg() const
    {
        std::string text = words(plot_left, 18.0, "start", panel_.title) + axes();
        for (const PlottedCurve& curve : panel_.curves)
            text += drawn(curve);
        return text;
    }

  private:
    [[nodiscard]] double x_of(double x) const
    {
        const auto on_axis = [&](double value) { return panel_.logarithmic ? std::log(value) : value; };
        const double part = (on_axis(x) - on_axis(panel_.x_from)) / (on_axis(panel_.x_to) - on_axis(panel_.x_from));
        return plot_left + part * (plot_right - plot_left);
    }

    [[nodiscard]] double y_of(double y) const
    {
        const double part = (std::log10(y) - powers_.first) / (powers_.second - powers_.first);
        return plot_bottom - part * (plot_bottom - plot_top);
    }

    [[nodiscard]] std::string axes() const
    {
        std::string text;
        const int apart = 1 + (powers_.second - powers_.first) / 8;
        for (int power = powers_.first; power <= powers_.second; power += apart) {
            const double y = y_of(std::pow(10.0, power));
            text += line(plot_left, y, plot_right, y, "#9aa3ad55");
            text += words(plot_left - 5.0, y + 4.0, "end",
                          std::abs(power) > 3 ? fmt::format("1e{}", power) : csv_number(std::pow(10.0, power)));
        }
        text += line(plot_left, plot_bottom, plot_right, plot_bottom, "#8a939d");
        for (const double tick : panel_.x_ticks)
            text += words(x_of(tick), plot_bottom + 16.0, "middle", csv_number(tick));
        return text + words((plot_left + plot_right) / 2.0, plot_bottom + 32.0, "middle", panel_.x_title);
    }

    [[nodiscard]] std::string drawn(const PlottedCurve& curve) const
    {
        std::string path;
        std::string marks;
        bool pen_is_down = false;
        for (const auto& [x, y] : curve.points) {
            const bool is_there = can_be_drawn(y);
            if (is_there && curve.is_mark)
                marks += diamond(x_of(x), y_of(y), curve.colour);
            else if (is_there)
                path += fmt::format("{}{:.1f},{:.1f}", pen_is_down ? 'L' : 'M', x_of(x), y_of(y));
            pen_is_down = is_there;
        }
        return curve.is_mark ? marks
                             : fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\"><title>{}</title></path>\n",
                                           path, stroke_of(curve), curve.name);
    }

    const PlotPanel& panel_;
    std::pair<int, int> powers_;
};

/// Three names per row.
std::string drawn_legend(double y, const std::vector<PlottedCurve>& legend, const std::string& note)
{
    std::string text;
    for (std::size_t k = 0; k < legend.size(); ++k) {
        const double x = plot_left + legend_width * static_cast<double>(k % 3);
        const double here = y + 20.0 * static_cast<double>(k / 3);
        text += legend[k].is_mark ? diamond(x + 14.0, here, legend[k].colour)
                                  : line(x, here, x + 28.0, here, stroke_of(legend[k]));
        text += words(x + 34.0, here + 4.0, "start", legend[k].name);
    }
    return text + words(plot_left, y + 20.0 * static_cast<double>((legend.size() + 2) / 3) + 4.0, "start", note);
}

}  // namespace

std::string plot_svg(const std::vector<PlotPanel>& panels, int columns, const std::vector<PlottedCurve>& legend,
                     const std::string& note)
{
    const auto powers = powers_of_ten(panels);
    const auto n = static_cast<int>(panels.size());
    const int rows = (n + columns - 1) / columns;
    const double width = panel_width * std::max(columns, 2);
    const double height = rows * panel_height + 30.0 + 20.0 * static_cast<double>((legend.size() + 2) / 3);
    std::string text =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.1f} {1:.1f}\" width=\"{0:.1f}\" "
                    "font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#6b757f\">\n",
                    width, height);
    for (int k = 0; k < n; ++k)
        text += fmt::format("<g transform=\"translate({:.1f},{:.1f})\">\n{}</g>\n", panel_width * (k % columns),
                            panel_height * (k / columns), Drawing(panels[static_cast<std::size_t>(k)], powers).svg());
    return text + drawn_legend(rows * panel_height + 14.0, legend, note) + "</svg>\n";
}

}  // namespace seamflow
