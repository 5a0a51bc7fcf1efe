#pragma once

#include <limits>
#include <string_view>

#include "engine/options/motion_options.h"

namespace seamflow {

/// The subjects that an option concerns, as bits: rules name them to exclude or imply options.
namespace concern {
/// The cut into sub-meshes.
constexpr unsigned sub_meshes = 1U;
/// Sweeps over sub-meshes.
constexpr unsigned sweeps = 2U;
/// An option with which steps are sweeps unless another option decides how they are taken.
constexpr unsigned implies_sweeps = 4U;
/// The paper's method: no preset can be combined with such an option.
constexpr unsigned method = 8U;
/// Factorisations of sub-meshes.
constexpr unsigned factors = 16U;
constexpr unsigned converged_steps = 32U;
/// Any other choice of how the equations are solved.
constexpr unsigned solution = 64U;
/// All subjects above: the equations of a step. Steps that keep edges have no equations.
constexpr unsigned equations = (solution << 1U) - 1U;
/// Nothing in the results: they do not depend on such an option.
constexpr unsigned no_result = 128U;
/// The motion of the surface, or its shape after a step: not for fields on a surface that stays.
constexpr unsigned motion = 256U;
/// The equation of a flow: excludes methods that have no equation, such as removing noise.
constexpr unsigned equation = 512U;
/// How much is smoothed.
constexpr unsigned amount = 1024U;
/// Files and printed text: only programs have such an option.
constexpr unsigned files = 2048U;
/// Vertices, edges or faces of one mesh, by their numbers in a file.
constexpr unsigned numbers = 4096U;
/// The whole surface at once: not for a surface in tiles.
constexpr unsigned whole_surface = 8192U;
/// Output of a program on the steps of one mesh.
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
    /// For messages: what a number must be, and its unit. Empty: the option has no limits of its own; those of the
    /// order depend on the filter (see require_valid).
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

/// The properties of an option, without its value.
struct OptionTraits {
    /// The name of its field in FlowOptions.
    std::string_view field;
    /// Its name in command lines; empty: command lines do not have it.
    std::string_view option = {};
    /// The group in which --help lists it (see option_group).
    std::string_view group = {};
    /// Bits of `concern`.
    unsigned concerns = 0;
    /// For users: a line for --help, and further lines for the manual page alone.
    std::string_view text = {};
    Limits limits = {};
};

}  // namespace seamflow
