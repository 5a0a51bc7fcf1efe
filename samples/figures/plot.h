#pragma once

#include <string>
#include <utility>
#include <vector>

namespace seamflow {

/// A line through points, or where `is_mark` a diamond at each.
struct PlottedCurve {
    std::string name = {};
    /// x and y; where y is not a positive number the line has a gap.
    std::vector<std::pair<double, double>> points = {};
    std::string colour = {};
    /// As in SVG: "6 3"; empty: none.
    std::string dashes = {};
    bool is_mark = false;
};

/// One plot: x along a line or, where `logarithmic`, by powers; y by powers of ten.
struct PlotPanel {
    std::string title = {};
    std::string x_title = {};
    bool logarithmic = false;
    double x_from = 0.0;
    double x_to = 1.0;
    /// Values of x to write below the axis.
    std::vector<double> x_ticks = {};
    std::vector<PlottedCurve> curves = {};
};

/// Panels as one SVG, all with the same axis of y.
/// @param columns the number of panels side by side. @param legend the curves whose names and colours are explained
///        below. @param note the text below that.
std::string plot_svg(const std::vector<PlotPanel>& panels, int columns, const std::vector<PlottedCurve>& legend,
                     const std::string& note);

}  // namespace seamflow
