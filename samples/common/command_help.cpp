#include "samples/common/command_help.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "partition/version.h"

namespace seamflow {

namespace {

/// Of the program and of its groups, as --help lists them: positionals and options.
std::vector<const CLI::Option*> options_of(const CLI::App& app, bool is_positional)
{
    std::vector<const CLI::App*> groups = app.get_subcommands({});
    groups.insert(groups.begin(), &app);
    std::vector<const CLI::Option*> list;
    for (const CLI::App* group : groups)
        for (const CLI::Option* option : group->get_options({}))
            if (!option->get_group().empty() && option->nonpositional() != is_positional)
                list.push_back(option);
    return list;
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

/// Of "auto|never|TOL" those that are to be typed as they stand.
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

/// @param marked every character of these gets a backslash before it.
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

/// As roff prints it: hyphens that can be copied, lines as they are, no command at the beginning of any.
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

std::string roff_of(const CLI::Option& option)
{
    std::string heading;
    for (const std::string& name : names_of(option))
        heading += fmt::format("{}\\fB{}\\fR", heading.empty() ? "" : ", ", roff(name));
    if (takes_value(option) && !option.get_type_name().empty())
        heading += fmt::format(" \\fI{}\\fR", roff(option.get_type_name()));
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

}  // namespace

std::string man_page(const CLI::App& app)
{
    std::string title = app.get_name();
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string page = fmt::format(".TH {} 1 \"\" \"seamflow {}\" \"seamflow\"\n", title, version);
    page += fmt::format(".SH NAME\n{} \\- {}\n", app.get_name(), roff(app.get_description()));
    page += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [\\fIOPTIONS\\fR]", app.get_name());
    const auto positionals = options_of(app, true);
    for (const CLI::Option* positional : positionals)
        page += fmt::format(" \\fI{}\\fR", roff(positional->get_name()));
    page += "\n.SH ARGUMENTS\n";
    for (const CLI::Option* positional : positionals)
        page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(positional->get_name()), roff(positional->get_description()));
    page += ".SH OPTIONS\n";
    for (const CLI::Option* option : options_of(app, false))
        page += roff_of(*option);
    page +=
        ".SH EXIT STATUS\n0: success; 2: wrong usage; 3: unusable input; 4: the computation failed; 5: output could "
        "not be written; 130 and 143: interrupted.\n";
    page +=
        ".SH SEE ALSO\nsamples/programs.md, beside README.md in the folder of seamflow's documents, explains all of "
        "it.\n";
    return page;
}

std::string bash_completion(const CLI::App& app)
{
    std::vector<std::string> names;
    std::string cases;
    for (const CLI::Option* option : options_of(app, false)) {
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
    for (const CLI::Option* option : options_of(app, false))
        for (const std::string& name : names_of(*option)) {
            const std::vector<std::string> words = words_of(*option);
            const std::string action = words.empty() ? "_files" : fmt::format("({})", joined_words(words));
            const std::string value =
                takes_value(*option) ? fmt::format(":{}:{}", in_zsh(option->get_type_name()), action) : "";
            script += fmt::format(" \\\n    '{}[{}]{}'", name + (takes_value(*option) ? "=" : ""),
                                  in_zsh(option->get_description()), value);
        }
    return script + " \\\n    '*:file:_files'\n";
}

}  // namespace seamflow
