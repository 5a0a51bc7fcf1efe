#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/options/option_names.h"
#include "engine/options/option_rule.h"
#include "samples/options/all_options.h"
#include "samples/options/option_text.h"

namespace seamflow {

struct PresetTraits;

/// What the boundary of a surface does.
enum class BoundaryWord { Fixed, Free, Smooth };

template <>
struct OptionNames<BoundaryWord> {
    static constexpr NamedOption<BoundaryWord> list[]{
        {"fixed", BoundaryWord::Fixed}, {"free", BoundaryWord::Free}, {"smooth", BoundaryWord::Smooth}};
};

/// What is asked for of a mesh that is smoothed, in a file or in memory, and what follows from it (see settle).
struct SmoothRequest {
    /// All options except `labels`, `fixed_vertices`, the attachment and strength of vertices, which need the mesh.
    AllOptions options;
    BoundaryWord boundary = BoundaryWord::Fixed;
    /// The preset that was asked for, or is the default without an amount; null: none.
    const PresetTraits* preset = nullptr;
    /// The noise on which the preset is to base the amount, if it is known.
    std::optional<LengthOnMesh> noise;
    /// Whether to count the pairs of faces that cross each other, before and after.
    bool self_intersections = false;
    /// The options that were asked for, in the order of their table.
    std::vector<OptionTraits> given;
    /// As the user wrote them: "--radius", "1%".
    std::vector<std::string> arguments;

    /// Whether a radius gives the amount, which options no longer show once they are resolved.
    bool gives_radius = false;
    /// Whether the preset chooses the amount.
    bool chooses_amount = false;
    /// Options that a preset has chosen, as they would be typed, without the amount: "--steps 3". Empty: there is none.
    std::string chosen;
    /// The amount, as it would be typed, if that preset has one: "--radius 3%".
    std::string chosen_amount;
    /// Whether the user limits the iterations of a step: then it is no failure to reach the limit.
    bool limits_iterations = false;
    /// Whether the number of threads was left open.
    bool chooses_threads = false;
    /// Remarks on the options, one sentence each.
    std::vector<std::string> remarks;
};

/// Reads AccuracyOptions::tolerance and approach: "auto", "never", or a tolerance below 1.
TextReader reader_of_convergence(AccuracyOptions& accuracy);

/// An option of a request.
struct RequestOption {
    OptionTraits traits;
    /// The names of a flag that has several: "--paper,--plain". Empty: that of the traits.
    std::string names = {};
    /// How its text is read; without `store` where it needs numbers of vertices, edges or faces, which only a caller
    /// with files or arrays has.
    TextReader reader = {};
};

/// All options of a request, in the order in which they take effect; their readers store in it.
/// @param request must outlive the result.
std::vector<RequestOption> request_options(SmoothRequest& request);

/// Options that exclude each other, by their names.
std::vector<std::pair<std::string_view, std::string_view>> exclusions_of_requests();

/// Whether an option was given, by its name ("--radius").
bool is_given(const SmoothRequest& request, std::string_view option);

/// The first option that was given and has one of these concerns; empty: there is none.
std::string first_given(const SmoothRequest& request, unsigned concerns);

/// Which options were given, or chosen by a preset.
/// @param request must outlive the result.
AskedOptions asked_options(const SmoothRequest& request);

/// Completes a request whose options have been read: takes from a preset the values that no option gives, and
/// determines how to take steps if options imply it.
/// @throws OptionError for options that contradict each other, and for those that would have no effect.
void settle(SmoothRequest& request);

/// A request of options and their texts, settled.
/// @param texts "--radius" and "1%"; a flag has no text. @param arrays the names of options that are given as arrays.
/// @param is_for_fields whether fields diffuse on a surface that stays.
/// @throws OptionError as settle, and for texts that no value can be read from.
SmoothRequest request_of(const std::vector<std::pair<std::string, std::string>>& texts,
                         const std::vector<std::string>& arrays, bool is_for_fields = false);

}  // namespace seamflow
