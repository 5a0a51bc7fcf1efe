#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// How the authors of the paper ran a file of theirs. It takes the place of the rules of the paper where their mesh is
/// cut in two for the adapted Robin conditions.
struct AuthorsRun {
    /// Faces of the file; a file with another number of them is another mesh, for which this does not count.
    Index faces = 0;
    /// Sub-mesh A is the first so many faces.
    Index first_part = 0;
    /// Their Robin parameter, in 1/length; A solves first and Γ is not corrected then. Empty: the paper's rules.
    std::optional<double> p;
};

/// Where the mesh of a figure comes from.
struct FigureSource {
    /// Name of the authors' file.
    std::string_view file;
    std::optional<AuthorsRun> authors;
    /// Makes the stand-in with about so many vertices.
    PolygonMesh (*generate)(Index vertices) = nullptr;
    Index vertices = 0;
    /// The rows of the stand-in follow each other along y (1) or z (2).
    Eigen::Index axis = 1;
};

/// The mesh of a figure and its cut in two.
struct FigureMesh {
    /// The name of the file, or "generated".
    std::string name;
    PolygonMesh mesh;
    /// #F: 0 for sub-mesh A, 1 for B.
    std::vector<Index> labels;
    /// Where the mesh is the authors' own.
    std::optional<AuthorsRun> authors;
};

/// Reads the authors' file, or the same with the prefix "ddm__", from a folder if it is there, and makes the stand-in
/// else. A file is cut in two as the authors did, or else after the first half of its faces; the stand-in by rows.
/// @param folder empty: the stand-in.
/// @throws InputError for a file that cannot be read.
FigureMesh load(const FigureSource& source, const std::filesystem::path& folder);

/// Label 0 for the faces whose centroid lies in the lower half of the mesh along an axis, 1 for the others.
std::vector<Index> halves_by_rows(const PolygonMesh& mesh, Eigen::Index axis);

/// Label 0 for the first `first` faces, 1 for the others.
std::vector<Index> halves_by_number(const PolygonMesh& mesh, Index first);

}  // namespace seamflow
