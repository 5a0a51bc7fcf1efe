#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// How the authors of the paper ran a file of theirs that is cut in two.
struct AuthorsRun {
    /// The first `first_part` faces are one sub-mesh, the others the second.
    Index first_part = 0;
    /// Their Robin parameter, in 1/length. Empty: the conditions of the figure have none.
    std::optional<double> p;
    /// Whether the first faces always solve first and Γ is not corrected, as in their first figure only; otherwise the
    /// sub-mesh with the larger total curvature leads, and Γ is corrected after every step.
    bool uncorrected = false;
};

/// Where the mesh of a figure comes from.
struct FigureSource {
    /// Name of the authors' file.
    std::string_view file;
    std::optional<AuthorsRun> authors;
    /// Generates the stand-in with about that many vertices.
    PolygonMesh (*generate)(Index vertices) = nullptr;
    /// Vertices of the authors' file. A file with another number of them is another mesh.
    Index vertices = 0;
    /// The rows of the stand-in follow each other along y (1) or z (2).
    Eigen::Index axis = 1;
};

/// The mesh of a figure and its cut in two.
struct FigureMesh {
    /// The name of the file, or "generated".
    std::string name;
    PolygonMesh mesh;
    /// #F: 0 for one sub-mesh, 1 for the other.
    std::vector<Index> labels;
    /// How it is cut, in words.
    std::string cut;
    /// Whether it is the authors' own.
    bool is_theirs = false;
    /// Only with their own mesh, if it is cut.
    std::optional<AuthorsRun> authors;
};

/// The path of an authors' file in a folder, under its own name or with "ddm__" before it; empty if it does not exist.
/// @param folder empty: there is none.
std::filesystem::path find_file(std::string_view name, const std::filesystem::path& folder);

/// Reads the authors' file, or the same with the prefix "ddm__", from a folder if it exists, and generates the stand-in
/// otherwise. Their own file is cut in two as they did, another file of that name after the first half of its faces,
/// the stand-in by rows.
/// @param folder empty: the stand-in.
/// @throws InputError for a file that cannot be read.
FigureMesh load(const FigureSource& source, const std::filesystem::path& folder);

/// Label 0 for the faces whose centroid lies in the lower half of the mesh along an axis, 1 for the others.
std::vector<Index> halves_by_rows(const PolygonMesh& mesh, Eigen::Index axis);

/// Label 0 for the first `first` faces, 1 for the others.
std::vector<Index> halves_by_number(const PolygonMesh& mesh, Index first);

}  // namespace seamflow
