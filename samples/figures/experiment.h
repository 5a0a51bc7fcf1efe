#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/figures/mesh_source.h"

namespace seamflow {

/// Into what a mesh is cut.
enum class Pieces {
    /// Into nothing: the reference.
    One,
    /// Into two by rows, as in the paper (see FigureMesh::labels).
    Halves,
    /// By METIS.
    Metis,
};

/// By which options a flow runs.
enum class Settings {
    /// FlowOptions::plain().
    Plain,
    /// The library's defaults, whatever the conditions of the figure are.
    Default,
};

/// One of the flows of a figure.
struct Variant {
    Laplacian laplacian = Laplacian::Fujiwara;
    Pieces pieces = Pieces::One;
    /// With Pieces::Metis.
    int subdomains = 2;
    Conditions conditions = Conditions::AdaptedRobin;
    Settings settings = Settings::Plain;
};

/// As in the tables: "undecomposed", "adapted-robin", "schwarz", and "plain", "default".
std::string conditions_of(const Variant& variant);
std::string_view name_of(Settings settings);

/// An experiment of the paper, as data.
struct Experiment {
    std::string_view name;
    FigureSource source;
    /// dt, in length².
    double time_step = 0.0;
    int steps = 1;
    std::vector<Variant> variants;
};

/// All of them, in the order of the paper.
const std::vector<Experiment>& experiments();

/// The name of what the paper does not have: the same for 2, 4, 8, 16 and 32 sub-meshes.
inline constexpr std::string_view many_sub_meshes = "subdomains";

/// The decomposed flows of an experiment with 2, 4, 8, 16 and 32 sub-meshes by METIS, plain and by the library's
/// defaults, instead of its own; those Laplacians whose decomposed flow the figure shows.
Experiment with_many_sub_meshes(const Experiment& experiment);

/// The options of one flow on the mesh of its figure. With Pieces::Halves the paper to the letter, except for what
/// AuthorsRun says of the authors' own mesh.
FlowOptions options_of(const Experiment& experiment, const Variant& variant, const FigureMesh& mesh);

}  // namespace seamflow
