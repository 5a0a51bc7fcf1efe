#pragma once

#include <limits>
#include <string_view>

#include "engine/options/motion_options.h"

namespace seamflow {

/// What an option concerns, so that others exclude or imply it.
namespace concern {
constexpr unsigned sub_meshes = 1U;
constexpr unsigned sweeps = 2U;
/// An option that makes sweeps the way of taking steps, where nothing else is asked for.
constexpr unsigned implies_sweeps = 4U;
/// An option of the paper's method, which no preset can be combined with.
constexpr unsigned method = 8U;
/// Factorisations of sub-meshes.
constexpr unsigned factors = 16U;
constexpr unsigned converged_steps = 32U;
/// How the equations are solved, in any other way.
constexpr unsigned solution = 64U;
/// All these: the equations of a step, which steps that keep edges do not have.
constexpr unsigned equations = (solution << 1U) - 1U;
/// The result of a step does not depend on it.
constexpr unsigned no_result = 128U;
/// Where the surface goes, or what it looked like after a step: not for fields on a surface that stays.
constexpr unsigned motion = 256U;
/// The equation of a flow: it rules out what needs none, like removing noise.
constexpr unsigned equation = 512U;
/// How much is smoothed.
constexpr unsigned amount = 1024U;
/// Files and printed text: only programs have such an option.
constexpr unsigned files = 2048U;
/// Vertices, edges or faces of one mesh by their numbers, from a file.
constexpr unsigned numbers = 4096U;
/// All of the surface at once, so that tiles of one cannot have it.
constexpr unsigned whole_surface = 8192U;
/// What a run shows of the steps of one mesh.
constexpr unsigned one_mesh = 16384U;
}  // namespace concern

/// The groups in which --help lists options.
namespace option_group {

inline constexpr std::string_view amount = "How much is smoothed";
inline constexpr std::string_view kind = "What kind of mesh";
inline constexpr std::string_view kept = "What stays";
inline constexpr std::string_view fields = "Fields on the surface";
inline constexpr std::string_view written = "What is written";
inline constexpr std::string_view accuracy = "Accuracy";
inline constexpr std::string_view sub_meshes = "Sub-meshes";
inline constexpr std::string_view machine = "Machine";

}  // namespace option_group

/// The limits of a number.
struct Limits {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    /// Whether the limits themselves are refused.
    bool above_least = false;
    bool below_most = true;
    /// For messages: what a number must be, and its unit. Empty: the limits depend on other options (see
    /// require_valid).
    std::string_view text = {};

    [[nodiscard]] bool hold(double value) const
    {
        return (above_least ? value > least : value >= least) && (below_most ? value < most : value <= most);
    }
};

inline constexpr Limits limits_of_steps{0.0, most_steps, false, false, "at least 0 and at most 1000000000"};
inline constexpr Limits limits_of_edge_angle{0.0, 180.0, true, true, "above 0 and below 180 (degrees)"};
inline constexpr Limits limits_of_threads{0.0, most_threads, false, false,
                                          "at least 0 and at most 1024 (0: as many as the calling TBB arena has)"};

struct OptionTraits {
    /// Its name in FlowOptions.
    std::string_view field;
    /// That of programs; empty: they do not have it.
    std::string_view option = {};
    /// In which --help lists it.
    std::string_view group = {};
    unsigned concerns = 0;
    /// For users: a line for --help, and on further lines what the manual page says in addition.
    std::string_view text = {};
    Limits limits = {};
};

}  // namespace seamflow
