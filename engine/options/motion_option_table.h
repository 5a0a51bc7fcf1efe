#pragma once

#include <limits>
#include <string_view>
#include <tuple>

#include "engine/options/motion_options.h"
#include "engine/options/option_traits.h"

namespace seamflow {

/// A row of a table of options, with the value.
template <class Value>
struct OptionRow : OptionTraits {
    Value* value;
};

template <class Value>
OptionRow<Value> row(Value& value, const OptionTraits& traits)
{
    return {traits, &value};
}

/// Calls action with every row of a table.
template <class Table, class Action>
void for_each_row(const Table& table, Action&& action)
{
    std::apply([&](const auto&... rows) { (action(rows), ...); }, table);
}

/// Calls action with the rows of two tables of the same options, in pairs.
template <class Table, class Action>
void for_each_pair(const Table& one, const Table& other, Action&& action)
{
    std::apply(
        [&](const auto&... of_one) {
            std::apply([&](const auto&... of_other) { (action(of_one, of_other), ...); }, other);
        },
        one);
}

/// The limits of a number that is to be above 0 and finite.
constexpr Limits positive(std::string_view text)
{
    return {0.0, std::numeric_limits<double>::infinity(), true, true, text};
}

/// The limits of a number that is to be at least 0 and finite.
constexpr Limits not_negative(std::string_view text)
{
    return {0.0, std::numeric_limits<double>::infinity(), false, true, text};
}

inline constexpr Limits limits_of_radius =
    positive("positive and finite (a length, or a part of the bounding box's diagonal)");
inline constexpr Limits limits_of_time_step = positive("positive and finite (length²)");
inline constexpr Limits limits_of_time_step_edges = positive("positive and finite (squared mean edge lengths)");

/// The table of all options of motion, in the order of --help. A further field of MotionOptions has one row here; the
/// compiler asks for it.
/// @param motion MotionOptions, const or not; the rows refer to it.
template <class Motion>
auto motion_table(Motion& motion)
{
    using namespace concern;
    auto& [weld, boundary, junctions, fixed_vertices, feature_edges, strict, attachment, attachment_radius,
           attachment_weights, strength, feather, direction, rescale, within, limits] = motion;
    auto& [volume, move, slide] = limits;
    namespace group = option_group;
    return std::tuple{
        row(within, {"within", "--within", group::amount, concern::motion,
                     "no vertex ends further than this from where it was, in all directions or along x, y and z\n"
                     "Vertices beyond it are moved back to it, and their neighbours follow smoothly.",
                     positive("above 0 and finite (a length; empty: no bound)")}),
        row(rescale, {"rescale", "--rescale", group::amount, equation | concern::motion | whole_surface,
                      "scale the result to the area or volume of the input [none]\n"
                      "Each component keeps its centroid. Not with fixed vertices; open surfaces therefore need "
                      "--boundary free."}),
        row(feature_edges, {"feature_edges", "--edges", group::kept, concern::motion | numbers,
                            "further edges to keep: two vertex numbers per line, from 0, or an .obj or .ply with them\n"
                            "They are kept whatever their angle. An .obj has polylines, a .ply elements edge. With "
                            "--keep-edges or --preset cad."}),
        row(boundary, {"boundary", "--boundary", group::kept, 0,
                       "the boundary of an open surface stays, shrinks freely, or alone moves, as a curve [fixed]"}),
        row(junctions, {"junctions", "--junctions", group::kept, 0,
                        "edges of three faces or more, where sheets meet: they move with all sheets, or stay [flow]"}),
        row(fixed_vertices, {"fixed_vertices", "--fix", group::kept, numbers,
                             "fixed vertices: their numbers from 0, one a line, or a .ply that marks them\n"
                             "The .ply has as many vertices, and a property that is not 0 at fixed ones."}),
        row(attachment, {"attachment", "--attach", group::kept, equation | concern::motion,
                         "pull every vertex towards where it was: features larger than this stay",
                         not_negative("at least 0 and finite (1/length²)")}),
        row(attachment_radius,
            {.field = "attachment_radius",
             .concerns = equation | concern::motion | no_result,
             .limits = positive("positive and finite (a length, or a part of the bounding box's diagonal)")}),
        row(attachment_weights,
            {"attachment_weights", "--attach-weights", group::kept, equation | concern::motion | numbers,
             "how strongly each vertex is pulled back, in 1/length²: one number per line, or a .ply\n"
             "The .ply has as many vertices, and a property with the weight."}),
        row(strength, {"strength", "--region", group::kept, concern::motion | numbers,
                       "smooth only there: vertex numbers from 0, one a line, or a .ply that has the strength of each\n"
                       "The strength, from 0 to 1, scales the time step at its vertex; 0 holds it. A name that is no "
                       "file is that of a property of INPUT, a .ply. Not for sweeps."}),
        row(feather, {"feather", "--feather", group::kept, concern::motion | whole_surface | no_result,
                      "the strength of the region rises from 0 at its rim over this distance, so that no crease "
                      "appears\n"
                      "The boundary of the surface is no rim.",
                      positive("positive and finite (a length, or a part of the bounding box's diagonal)")}),
        row(direction, {"direction", "--direction", group::kept, concern::motion,
                        "vertices move along this direction only; with z, x and y of a terrain stay bit for bit\n"
                        "normal is that of each vertex after the step."}),
        row(weld, {"weld", "--weld", group::kept, 0,
                   "copies of vertices along seams, at most this far apart, move as one [at equal places]\n"
                   "A seam is where edges of one face each coincide, for example along those of a texture.",
                   not_negative("at least 0 and finite (a length; empty: never)")}),
        row(strict, {"strict", "--strict", group::kept, no_result | concern::motion,
                     "refuse meshes that are not manifold or have edges or faces of size 0\n"
                     "Without it, such vertices stay fixed, and unusable faces are left out."}),
        row(volume, {"limit_of_volume"}),
        row(move, {"limit_of_move"}),
        row(slide, {"limit_of_slide"})};
}

}  // namespace seamflow
