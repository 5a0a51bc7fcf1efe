#include "samples/common/option_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace seamflow {

namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// Wherever they stand.
constexpr std::array<Words, 12> anywhere{{{"Approach::Sweep", "--approach sweep"},
                                          {"Filter::LowPass", "--filter low-pass"},
                                          {"attachment_weights", "--attach-weights"},
                                          {"converge_iterations", "--converge-iterations"},
                                          {"feature_edges", "--edges"},
                                          {"fixed_vertices", "--fix"},
                                          {"keep_edges", "--keep-edges"},
                                          {"keep_gaps", "--keep-gaps"},
                                          {"memory_limit", "--memory-limit"},
                                          {"p_edge", "--p-edge"},
                                          {"p_rule", "--p-rule"},
                                          {"time_step", "--time-step"}}};

/// Where a message begins with them.
constexpr std::array<Words, 26> subjects{{{"approach", "--approach"},
                                          {"attachment", "--attach"},
                                          {"boundary", "--boundary"},
                                          {"colouring", "--coloring"},
                                          {"conditions", "--conditions"},
                                          {"factorisation", "--factorisation"},
                                          {"filter", "--filter"},
                                          {"flow", "--flow"},
                                          {"labels", "--labels"},
                                          {"laplacian", "--laplacian"},
                                          {"order", "--order"},
                                          {"overlap", "--overlap"},
                                          {"p", "--p"},
                                          {"precision", "--precision"},
                                          {"q", "--q"},
                                          {"radius", "--radius"},
                                          {"rescale", "--rescale"},
                                          {"scheme", "--scheme"},
                                          {"steps", "--steps"},
                                          {"subdomains", "--subdomains"},
                                          {"sweep", "--sweep"},
                                          {"threads", "--threads"},
                                          {"tolerance", "--converge"},
                                          {"transmission", "--transmission"},
                                          {"weld", "--weld"},
                                          {"within", "--within"}}};

bool is_of_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:").find(c) != std::string_view::npos;
}

/// Whether text[begin, end) is no part of a longer name, of a file for instance. A colon, a full stop or a blank may
/// follow it.
bool stands_alone(std::string_view text, std::size_t begin, std::size_t end)
{
    if (begin > 0 && is_of_word(text[begin - 1]))
        return false;
    if (end == text.size() || !is_of_word(text[end]))
        return true;
    return (text[end] == ':' || text[end] == '.') && (end + 1 == text.size() || text[end + 1] == ' ');
}

}  // namespace

std::string in_words_of_options(std::string_view message)
{
    constexpr std::string_view another_flow = "another flow: ";
    const auto found = message.find(another_flow);
    const std::size_t begin = found == std::string_view::npos ? 0 : found + another_flow.size();
    const std::string_view first = message.substr(begin, message.find(' ', begin) - begin);
    const auto subject = std::ranges::find(subjects, first, &Words::first);
    std::string text(message);
    if (subject != subjects.end())
        text.replace(begin, first.size(), subject->second);
    for (const auto& [field, option] : anywhere)
        for (auto at = text.find(field); at != std::string::npos; at = text.find(field, at + 1))
            if (stands_alone(text, at, at + field.size()))
                text.replace(at, field.size(), option);
    return text;
}

std::string in_words_of_keywords(std::string_view message)
{
    std::string text;
    for (std::size_t i = 0; i < message.size(); ++i) {
        const bool begins = message.substr(i).starts_with("--") && (i == 0 || !is_of_word(message[i - 1])) &&
                            i + 2 < message.size() && std::islower(static_cast<unsigned char>(message[i + 2])) != 0;
        if (!begins) {
            text += message[i];
            continue;
        }
        for (i += 2;
             i < message.size() && (message[i] == '-' || std::isalnum(static_cast<unsigned char>(message[i])) != 0);
             ++i)
            text += message[i] == '-' ? '_' : message[i];
        --i;
    }
    return text;
}

}  // namespace seamflow
