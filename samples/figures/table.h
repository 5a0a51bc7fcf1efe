#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partition/metrics/length_statistics.h"
#include "partition/polygon_mesh.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The state of one flow after one step. Lengths are in mean edge lengths of the undecomposed flow's mesh after the
/// same step, as in the paper.
struct Row {
    std::string figure;
    /// File name, or "generated".
    std::string mesh;
    Index vertices = 0;
    Laplacian laplacian = Laplacian::Fujiwara;
    /// See conditions_of.
    std::string conditions;
    /// How many sub-meshes there were.
    Index subdomains = 1;
    /// From 1.
    int step = 0;
    /// Distances of corresponding vertices, and of the reference's vertices from the surface, to the undecomposed flow;
    /// not a number where there is no such flow any more.
    LengthStatistics v;
    LengthStatistics h;
    /// Wall-clock time of the step.
    double seconds = 0.0;
    /// "plain" or "default".
    std::string settings;
    /// Mean over the vertices: how far their texture was dragged since the beginning (see TotalDisplacement::drift).
    double drift = 0.0;
    /// See roughness.
    double roughness = 0.0;
};

/// What one experiment gave.
struct Table {
    std::string figure;
    std::string mesh;
    /// Whether the flows ran as the authors ran theirs on this mesh (see AuthorsRun::p).
    bool as_authors = false;
    int steps = 0;
    /// Of the input.
    double roughness = 0.0;
    std::vector<Row> rows;
    /// Flows that ended before their time, and why; a sentence each.
    std::vector<std::string> remarks;

    /// The row of a flow in halves or undecomposed after a step; nullptr: there is none.
    [[nodiscard]] const Row* find(Laplacian laplacian, std::string_view conditions, int step) const;
};

/// Writes tables one after the other as CSV under one header: figure, mesh, vertices, laplacian, conditions,
/// subdomains, step, v_mean, v_rms, v_max, h_mean, h_rms, h_max, seconds, options, drift_mean, roughness.
/// @throws OutputError naming the file.
void write_csv(const std::filesystem::path& path, const std::vector<Table>& tables);

/// A number with six significant digits; "nan" if it is none.
std::string csv_number(double value);

/// A text in quotation marks where CSV needs them.
std::string csv_text(std::string_view text);

}  // namespace seamflow
