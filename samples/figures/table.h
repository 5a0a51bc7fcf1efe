#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partition/metrics/length_statistics.h"
#include "partition/metrics/roughness.h"
#include "partition/polygon_mesh.h"
#include "samples/figures/experiment.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The state of one flow after one step. Lengths are in mean edge lengths of the undecomposed flow's mesh after the
/// same step, as in the paper.
struct Row {
    Laplacian laplacian = Laplacian::Fujiwara;
    /// See conditions_of.
    std::string conditions;
    /// The number of sub-meshes.
    Index subdomains = 1;
    /// From 1.
    int step = 0;
    /// Distances of corresponding vertices, and of the reference's vertices from the surface, to the undecomposed flow;
    /// not a number after the end of that flow.
    LengthStatistics v;
    LengthStatistics h;
    /// Wall-clock time of the step.
    double seconds = 0.0;
    /// "plain" or "default".
    std::string settings;
    /// Mean over the vertices: how far their texture was dragged since the beginning (see TotalDisplacement::drift).
    double drift = 0.0;
    Roughness roughness;
    /// Length of the interface of a flow in two halves, in lengths of the same edges of the undecomposed flow; else not
    /// a number.
    double interface_length = 0.0;
    /// The half that solves first, 0 or 1; empty: there are no halves, or they do not meet.
    std::string leading;
    /// The Robin parameter, in 1/length, of the sub-mesh that solves first, or from the smallest to the largest of many
    /// ("6.3 to 9.8"), and the Ventcell parameter; empty where there is none.
    std::string p;
    std::string q;
    /// How the mesh was cut, in words.
    std::string cut;
    /// See command_of.
    std::string command;
    /// See title_of and words_of.
    std::string title;
    std::string words;
};

/// The results of one experiment.
struct Table {
    std::string figure;
    /// File name, or "generated".
    std::string mesh;
    Index vertices = 0;
    /// Whether it is the authors' own (see FigureMesh::is_theirs).
    bool is_theirs = false;
    /// dt, in length².
    double time_step = 0.0;
    int steps = 0;
    /// Of the input.
    Roughness roughness;
    /// The area of the input's surface, in length².
    double area = 0.0;
    /// The authors' results, on their own mesh (see is_theirs).
    std::vector<AuthorsDistances> theirs;
    /// All flows of the experiment; one that ended early has fewer rows than steps.
    std::vector<Variant> flows;
    std::vector<Row> rows;
    /// Flows that ended early, and why; one sentence each.
    std::vector<std::string> remarks;

    /// The row of a flow in halves or undecomposed after a step; nullptr: there is none.
    [[nodiscard]] const Row* find(Laplacian laplacian, std::string_view conditions, int step) const;

    /// The row of any flow after a step; nullptr: there is none.
    [[nodiscard]] const Row* find(const Variant& variant, int step) const;

    /// The authors' results for the flow of a row; not numbers where they are not known.
    [[nodiscard]] AuthorsDistances theirs_of(const Row& row) const;

    /// Whether there are distances over the steps to draw: of a decomposed flow, after two steps or more.
    [[nodiscard]] bool has_curves() const;

    /// The last row of each flow.
    [[nodiscard]] std::vector<Row> last_rows() const;
};

/// Writes tables one after the other as CSV under one header: figure, mesh, vertices, laplacian, conditions,
/// subdomains, step, v_mean, v_rms, v_max, h_mean, h_rms, h_max, seconds, options, drift_mean, roughness, roughness_95,
/// interface_length, area, leading, authors_v_mean, authors_v_max, dt, p, q, cut, command.
/// @throws OutputError naming the file.
void write_csv(const std::filesystem::path& path, const std::vector<Table>& tables);

/// A number with six significant digits; "nan" if it is none.
std::string csv_number(double value);

/// A text in quotation marks where CSV needs them.
std::string csv_text(std::string_view text);

}  // namespace seamflow
