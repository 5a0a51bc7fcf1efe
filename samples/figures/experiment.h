#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/figures/mesh_source.h"

namespace seamflow {

/// How a mesh is cut.
enum class CutKind {
    /// Not at all: the reference.
    Uncut,
    /// Into two, as in the paper (see FigureMesh::labels).
    Halves,
    /// By METIS.
    Metis,
};

/// The options with which a flow runs.
enum class Settings {
    /// FlowOptions::plain().
    Plain,
    /// The library's defaults, whatever the conditions of the figure are.
    Default,
};

/// One of the flows of a figure.
struct Variant {
    Laplacian laplacian = Laplacian::Fujiwara;
    CutKind cut = CutKind::Uncut;
    /// With CutKind::Metis.
    int subdomains = 2;
    Conditions conditions = Conditions::AdaptedRobin;
    Settings settings = Settings::Plain;
};

/// As in the tables: "undecomposed", "adapted-robin", "adapted-ventcell", "schwarz", and "plain", "default".
std::string conditions_of(const Variant& variant);
std::string_view name_of(Settings settings);

/// A flow in the names of files, "fujiwara-schwarz" or "fujiwara-adapted-robin-8-plain", and in words, "Δ_F in two
/// sub-meshes, Schwarz".
std::string title_of(const Variant& variant);
std::string words_of(const Variant& variant);

/// The results of the authors' own code after the last step on their own mesh, in mean edge lengths.
struct AuthorsDistances {
    Laplacian laplacian = Laplacian::Fujiwara;
    Conditions conditions = Conditions::AdaptedRobin;
    double v_mean = 0.0;
    /// Not a number: not known.
    double v_max = 0.0;
};

/// Names in a row of pictures that replace the title of a flow.
namespace picture_of {
inline constexpr std::string_view input = "input";
/// The input, a colour for each sub-mesh.
inline constexpr std::string_view cut = "cut";
/// The sub-mesh that solves first.
inline constexpr std::string_view part = "part";
}  // namespace picture_of

/// An experiment of the paper, as data.
struct Experiment {
    std::string_view name;
    /// The number of its figure in the paper (arXiv 2602.16874).
    int figure = 0;
    /// The contents of the figure in a few words, and the paper's statements on it.
    std::string_view heading;
    std::string_view text;
    FigureSource source;
    /// dt, in length².
    double time_step = 0.0;
    int steps = 1;
    std::vector<Variant> variants;
    /// Rows of pictures, each a picture_of or the title of a flow, in the order of the paper.
    std::vector<std::vector<std::string>> pictures;
    std::vector<AuthorsDistances> theirs;
    /// Why theirs differ from ours, where they do.
    std::string_view difference;
};

}  // namespace seamflow
