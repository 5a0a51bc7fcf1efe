#include "samples/command/command_help.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/options/option_traits.h"
#include "partition/formats/mesh_io.h"
#include "partition/version.h"

namespace seamflow {

namespace {

/// In the order of --help-all; options of no group come last.
constexpr std::array<std::string_view, 9> groups{
    option_group::amount,     option_group::kind,    option_group::kept,
    option_group::fields,     option_group::written, option_group::accuracy,
    option_group::sub_meshes, option_group::machine, "Options"};

std::vector<const CLI::Option*> positionals_of(const CLI::App& app)
{
    return app.get_options([](const CLI::Option* option) { return !option->nonpositional(); });
}

std::vector<const CLI::Option*> options_of_group(const CLI::App& app, std::string_view group)
{
    return app.get_options(
        [&](const CLI::Option* option) { return option->nonpositional() && option->get_group() == group; });
}

/// "-h", "--help".
std::vector<std::string> names_of(const CLI::Option& option)
{
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back(fmt::format("-{}", name));
    for (const std::string& name : option.get_lnames())
        names.push_back(fmt::format("--{}", name));
    return names;
}

bool takes_value(const CLI::Option& option)
{
    return option.get_items_expected_max() > 0;
}

/// "--steps INTEGER".
std::string heading_of(const CLI::Option& option)
{
    std::string heading = fmt::format("{}", fmt::join(names_of(option), ", "));
    if (takes_value(option) && !option.get_type_name().empty())
        heading += " " + option.get_type_name();
    return heading;
}

/// The line of the description in --help-all.
std::string first_line(const CLI::Option& option)
{
    const std::string& text = option.get_description();
    return text.substr(0, text.find('\n'));
}

/// Indents each line by two blanks.
std::string with_indent(std::string_view text)
{
    std::string result;
    for (const std::string& line : CLI::detail::split(std::string(text), '\n'))
        if (!line.empty())
            result += fmt::format("  {}\n", line);
    return result;
}

/// "  heading   text", with the text in a column where the heading leaves room for it, in several lines if it is long.
std::string line_of(const std::string& heading, std::string text)
{
    constexpr std::size_t most = 130;
    std::string lines = fmt::format("  {:<26}  ", heading);
    for (std::size_t blank; text.size() > most && (blank = text.rfind(' ', most)) != std::string::npos;) {
        lines.append(text, 0, blank).append(fmt::format("\n{:30}", ""));
        text.erase(0, blank + 1);
    }
    return lines + text + "\n";
}

/// "INPUT", or "[FIGURE …]" for any number of arguments.
std::string name_in_usage(const CLI::Option& positional)
{
    const char* const more = positional.get_items_expected_max() > 1 ? " …" : "";
    return positional.get_required() ? positional.get_name() : fmt::format("[{}{}]", positional.get_name(), more);
}

/// "smooth [OPTIONS] INPUT OUTPUT".
std::string usage_of(const CLI::App& app)
{
    std::string usage = app.get_name() + " [OPTIONS]";
    for (const CLI::Option* positional : positionals_of(app))
        usage += " " + name_in_usage(*positional);
    return usage;
}

bool speaks_of_lengths(const CLI::App& app)
{
    return std::ranges::any_of(app.get_options({}), [](const CLI::Option* option) {
        return option->get_type_name().find("LENGTH") != std::string::npos;
    });
}

constexpr const char* about_lengths = "A LENGTH is in the units of the file, or with % a part of the bounding box's "
                                      "diagonal: 0.5, 2%.";

/// The words of "auto|never|TOL" that are typed literally.
std::vector<std::string> words_of(const CLI::Option& option)
{
    std::vector<std::string> words = CLI::detail::split(option.get_type_name(), '|');
    if (words.size() < 2)
        return {};
    std::erase_if(words, [](const std::string& word) {
        return std::ranges::any_of(word, [](unsigned char c) { return std::isupper(c) != 0; });
    });
    return words;
}

std::string joined_words(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, " "));
}

/// @param marked the characters that are preceded by a backslash.
std::string with_backslashes(std::string_view text, std::string_view marked)
{
    std::string result;
    for (const char c : text) {
        if (marked.find(c) != std::string_view::npos)
            result += '\\';
        result += c;
    }
    return result;
}

/// Escaped for roff: hyphens that can be copied, lines as they are, no command at the beginning of any.
std::string roff(std::string_view text)
{
    std::string result = "\\&";
    for (const char c : text)
        if (c == '\n')
            result += "\n.br\n\\&";
        else
            result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    return result;
}

/// Lines may break after the words of "auto|never|TOL".
std::string with_breaks(std::string_view text)
{
    std::string result;
    for (const char c : text)
        result += c == '|' ? "|\\:" : std::string(1, c);
    return result;
}

std::string roff_of(const CLI::Option& option)
{
    std::string heading;
    for (const std::string& name : names_of(option))
        heading += fmt::format("{}\\fB{}\\fR", heading.empty() ? "" : ", ", roff(name));
    if (takes_value(option) && !option.get_type_name().empty())
        heading += fmt::format(" \\fI{}\\fR", with_breaks(roff(option.get_type_name())));
    return fmt::format(".TP\n{}\n{}\n", heading, roff(option.get_description()));
}

/// A text within single quotes of zsh and the brackets or colons of _arguments.
std::string in_zsh(std::string_view text)
{
    std::string result;
    for (const char c : with_backslashes(text, "\\[]:"))
        result += c == '\'' ? "'\\''" : std::string(1, c);
    return result;
}

std::vector<const CLI::Option*> options_by_groups(const CLI::App& app)
{
    std::vector<const CLI::Option*> list;
    for (const std::string_view group : groups)
        for (const CLI::Option* option : options_of_group(app, group))
            list.push_back(option);
    return list;
}

/// What stands before the options.
std::string beginning_of_help(const CLI::App& app)
{
    std::string text = fmt::format("{}\n\nUsage: {}\n", app.get_description(), usage_of(app));
    for (const CLI::Option* positional : positionals_of(app))
        text += line_of(positional->get_name(), first_line(*positional));
    return text + fmt::format("\nExamples:\n{}", with_indent(app.get_footer()));
}

}  // namespace

std::string short_help_text(const CLI::App& app, std::span<const std::string_view> common)
{
    std::string text = beginning_of_help(app) + "\nOptions that most people need:\n";
    for (const std::string_view name : common)
        if (const CLI::Option* option = app.get_option_no_throw(std::string(name)); option != nullptr)
            text += line_of(heading_of(*option), first_line(*option));
    return text +
           fmt::format("\n{0}\n{1} --help-all lists all options; man {1}, or {1} --help-man | man -l -, says more.\n",
                       about_lengths, app.get_name());
}

std::string help_text(const CLI::App& app)
{
    std::string text = beginning_of_help(app);
    for (const std::string_view group : groups) {
        const auto options = options_of_group(app, group);
        if (options.empty())
            continue;
        text += fmt::format("\n{}:\n", group);
        for (const CLI::Option* option : options)
            text += line_of(heading_of(*option), first_line(*option));
    }
    if (speaks_of_lengths(app))
        text += fmt::format("\n{}\n", about_lengths);
    return text + fmt::format("\nman {0} says more about each; where it is not installed, {0} --help-man | man -l -\n",
                              app.get_name());
}

std::string man_page(const CLI::App& app)
{
    std::string title = app.get_name();
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string page = fmt::format(".TH {} 1 \"\" \"seamflow {}\" \"seamflow\"\n", title, version);
    page += fmt::format(".SH NAME\n{} \\- {}\n", app.get_name(), roff(app.get_description()));
    page += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [\\fIOPTIONS\\fR]", app.get_name());
    const auto positionals = positionals_of(app);
    for (const CLI::Option* positional : positionals)
        page += fmt::format(" \\fI{}\\fR", roff(name_in_usage(*positional)));
    page += fmt::format("\n.SH EXAMPLES\n.nf\n{}\n.fi\n.SH ARGUMENTS\n", roff(app.get_footer()));
    for (const CLI::Option* positional : positionals)
        page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(positional->get_name()), roff(positional->get_description()));
    page += ".SH OPTIONS\n";
    if (speaks_of_lengths(app))
        page += roff(about_lengths) + "\n";
    for (const std::string_view group : groups)
        if (const auto options = options_of_group(app, group); !options.empty()) {
            page += fmt::format(".SS {}\n", group);
            for (const CLI::Option* option : options)
                page += roff_of(*option);
        }
    page += ".SH EXIT STATUS\n.TP\n0\nsuccess\n.TP\n2\nwrong usage\n.TP\n3\nunusable input\n.TP\n4\nthe computation "
            "failed\n.TP\n5\noutput could not be written\n.TP\n130, 143\ninterrupted\n";
    page += fmt::format(".SH FILES\nMeshes are {} files, packed by gzip with .gz behind that. What comes from standard "
                        "input is known by its content.\n.PP\n"
                        "samples/programs.md, beside README.md in the folder of seamflow's documents, explains all "
                        "of it.\n",
                        extensions_of());
    page += ".SH SEE ALSO\n";
    std::string others;
    for (const char* const program :
         {"smooth", "smooth-distributed", "compare", "inspect", "generate", "figures", "benchmark"})
        if (program != app.get_name())
            others += fmt::format("{}\\fB{}\\fR(1)", others.empty() ? "" : ", ", roff(program));
    return page + others + "\n";
}

std::string bash_completion(const CLI::App& app)
{
    std::vector<std::string> names;
    std::string cases;
    for (const CLI::Option* option : options_by_groups(app)) {
        const std::vector<std::string> own = names_of(*option);
        names.insert(names.end(), own.begin(), own.end());
        if (takes_value(*option))
            cases += fmt::format("    {}) COMPREPLY=($(compgen -W '{}' -- \"$current\")); return ;;\n",
                                 fmt::join(own, "|"), joined_words(words_of(*option)));
    }
    return fmt::format(R"(# Completes the options of {0} of seamflow.
_seamflow_{0}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
    [[ $previous == "=" ]] && previous=${{COMP_WORDS[COMP_CWORD-2]}}
    [[ $current == "=" ]] && current=""
    case $previous in
{1}    esac
    [[ $current == -* ]] && COMPREPLY=($(compgen -W '{2}' -- "$current"))
}}
complete -o default -F _seamflow_{0} {0}
)",
                       app.get_name(), cases, joined_words(names));
}

std::string zsh_completion(const CLI::App& app)
{
    std::string script = fmt::format("#compdef {}\n_arguments", app.get_name());
    for (const CLI::Option* option : options_by_groups(app))
        for (const std::string& name : names_of(*option)) {
            const std::vector<std::string> words = words_of(*option);
            const std::string action = words.empty() ? "_files" : fmt::format("({})", joined_words(words));
            const std::string value =
                takes_value(*option) ? fmt::format(":{}:{}", in_zsh(option->get_type_name()), action) : "";
            script += fmt::format(" \\\n    '{}[{}]{}'", name + (takes_value(*option) ? "=" : ""),
                                  in_zsh(first_line(*option)), value);
        }
    return script + " \\\n    '*:file:_files'\n";
}

}  // namespace seamflow
