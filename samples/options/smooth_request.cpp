#include "samples/options/smooth_request.h"

#include <algorithm>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "samples/process/option_words.h"

namespace seamflow {

namespace {

/// "scan: what it is for (--steps 3)", one preset per line.
std::string describe_presets()
{
    std::string text = "options for a kind of mesh [automatic if no amount is given]\n"
                       "Without an amount, options about equations choose scan, and edges choose cad. Options on the "
                       "command line override those of the preset.";
    const FlowOptions defaults;
    for (const PresetTraits& preset : all_presets()) {
        text += fmt::format("\n{}: {} (", preset.name, preset.purpose);
        const PresetSettings settings = apply_preset(preset, defaults, changed_options(defaults));
        for (const PresetSetting& one : settings.chosen)
            text += option_of_program(one.option, one.value) + " ";
        text += (preset.denoise            ? "and what the noise of each place asks for"
                 : preset.measures_noise() ? "and what the noise asks for"
                                           : option_of_program(settings.amount->option, settings.amount->value)) +
                ")";
    }
    return text;
}

std::optional<LengthOnMesh> parse_weld(const std::string& text)
{
    try {
        return text == "never" ? std::nullopt : std::optional(parse_length(text));
    } catch (const OptionError& error) {
        throw OptionError(std::string(error.what()) + ", nor never");
    }
}

/// The fields whose texts are others than those of their types.
std::map<std::string_view, TextReader> readers_of_fields(SmoothRequest& request)
{
    AllOptions& options = request.options;
    // Those that this build lacks are refused with the reason, by require_valid.
    TextReader factorisation = reader_of(options.resources.factorisation, {});
    if (gpl_parts().empty())
        factorisation.type = "auto|own";
    return {{"attachment", reader_of(options.motion.attachment_radius, {})},
            {"direction", reader_by(options.motion.direction, parse_direction, "x|y|z|normal|X,Y,Z")},
            {"boundary", reader_of(request.boundary, {})},
            {"weld", reader_by(options.motion.weld, parse_weld, "never|LENGTH")},
            {"tolerance", reader_of_convergence(options.accuracy)},
            {"factorisation", factorisation},
            {"correction", {"", [&options](const std::string&) { options.interface.correction = Correction::None; }}}};
}

/// An option of the table; without a reader where it needs numbers of vertices, edges or faces.
template <class Value>
RequestOption option_of(const OptionRow<Value>& row, const std::map<std::string_view, TextReader>& readers)
{
    RequestOption option{.traits = row};
    if (const auto found = readers.find(row.field); found != readers.end())
        option.reader = found->second;
    else if constexpr (IsReadable<Value>)
        option.reader = reader_of(*row.value, row.limits);
    return option;
}

/// Those that are no fields of a flow.
RequestOption option_of_paper(SmoothRequest& request)
{
    return {{"", "--paper", option_group::sub_meshes, concern::sweeps | concern::method,
             "the paper's method for any number of sub-meshes: a fixed sweep, derivatives at the old positions"},
            "--paper,--plain",
            {"", [&options = request.options](const std::string&) { options = FlowOptions::plain(); }}};
}

RequestOption option_of_noise(SmoothRequest& request)
{
    return {{"", "--noise", option_group::amount, concern::motion | concern::equation | concern::whole_surface,
             "noise that is the same everywhere, on rounded shapes: sharp edges lose by it [measured at each place]\n"
             "The standard deviation along the normals. A preset derives the amount of its equation from it."},
            "",
            reader_of(request.noise, {})};
}

RequestOption option_of_preset(SmoothRequest& request)
{
    static const std::string text = describe_presets();
    NamedValues<const PresetTraits*> names;
    for (const PresetTraits& preset : all_presets())
        names.emplace_back(preset.name, &preset);
    return {{"", "--preset", option_group::kind, concern::motion | concern::whole_surface, text},
            "",
            reader_of_words(request.preset, names)};
}

RequestOption option_of_intersections(SmoothRequest& request)
{
    return {{"", "--self-intersections", option_group::written, concern::motion | concern::whole_surface,
             "count the pairs of faces that cross each other, before and after; implied by --report"},
            "",
            reader_of(request.self_intersections, {})};
}

/// @throws OptionError
void require_none_excluded(const SmoothRequest& request)
{
    for (const auto& [one, other] : exclusions_of_requests())
        if (is_given(request, one) && is_given(request, other))
            seamflow::refuse(fmt::format("{} excludes {}", one, other));
}

}  // namespace

TextReader reader_of_convergence(AccuracyOptions& accuracy)
{
    const auto parse = [&accuracy](const std::string& text) {
        AccuracyOptions own = accuracy;
        own.approach = text == "never" ? Approach::Sweep : Approach::Automatic;
        own.tolerance.reset();
        try {
            if (text != "auto" && text != "never")
                own.tolerance = parse_real(text, positive());
        } catch (const OptionError& error) {
            throw OptionError(std::string(error.what()) + ", \"auto\" or \"never\"");
        }
        return own;
    };
    return reader_by(accuracy, parse, "auto|never|NUMBER");
}

std::vector<RequestOption> request_options(SmoothRequest& request)
{
    // First, so that the others refine it.
    std::vector<RequestOption> list{option_of_paper(request), option_of_noise(request), option_of_preset(request)};
    const std::map<std::string_view, TextReader> readers = readers_of_fields(request);
    list.push_back({row_of_rounded, "", reader_by(request.options.rounded, parse_rounding, "never|Q|X,Y,Z")});
    for_each_option(static_cast<FlowOptions&>(request.options), [&](const auto& row) {
        if (row.field == "feature_edges")
            list.push_back({row_of_keep_edges, "", reader_of(request.options.keep_edges, row_of_keep_edges.limits)});
        if (!row.option.empty())
            list.push_back(option_of(row, readers));
    });
    list.push_back(option_of_intersections(request));
    return list;
}

std::vector<std::pair<std::string_view, std::string_view>> exclusions_of_requests()
{
    return {{"--labels", "--subdomains"}, {"--attach-weights", "--attach"}};
}

bool is_given(const SmoothRequest& request, std::string_view option)
{
    return std::ranges::find(request.given, option, &OptionTraits::option) != request.given.end();
}

std::string first_given(const SmoothRequest& request, unsigned concerns)
{
    const auto found = std::ranges::find_if(
        request.given, [=](const OptionTraits& traits) { return (traits.concerns & concerns) != 0; });
    return found == request.given.end() ? "" : std::string(found->option);
}

AskedOptions asked_options(const SmoothRequest& request)
{
    const auto has = [&request](std::string_view option) {
        return is_given(request, option_of_program(option, "")) ||
               (option == "feature_edges" && is_given(request, "--edges-from-file")) ||
               (option == "attachment" && request.options.motion.attachment_radius) ||
               changed_options(request.options).has(option);
    };
    const auto first = [&request](unsigned concerns) {
        for (const OptionTraits& traits : request.given)
            if ((traits.concerns & concerns) != 0)
                return std::string(traits.field.empty() ? traits.option : traits.field);
        return std::string();
    };
    return {has, first};
}

SmoothRequest request_of(const std::vector<std::pair<std::string, std::string>>& texts,
                         const std::vector<std::string>& arrays, bool is_for_fields)
{
    SmoothRequest request;
    if (is_for_fields)
        request.given.push_back({.field = {}, .option = "--fields", .concerns = concern::files});
    const auto is_named = [](const RequestOption& option, const std::string& name) {
        return option.traits.option == name || (option.names + ",").find(name + ",") != std::string::npos;
    };
    for (const RequestOption& option : request_options(request)) {
        const auto text = std::ranges::find_if(texts, [&](const auto& one) { return is_named(option, one.first); });
        if (std::ranges::find(arrays, option.traits.option) != arrays.end()) {
            request.given.push_back(option.traits);
        } else if (text != texts.end() && option.reader.store) {
            request.given.push_back(option.traits);
            try {
                option.reader.store(text->second);
            } catch (const OptionError& error) {
                throw OptionError(text->first + ": " + error.what());
            }
        }
    }
    for (const auto& [name, text] : texts)
        request.arguments.push_back(text.empty() ? name : fmt::format("{}={}", name, text));
    require_none_excluded(request);
    settle(request);
    return request;
}

}  // namespace seamflow
