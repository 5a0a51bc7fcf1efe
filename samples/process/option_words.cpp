#include "samples/process/option_words.h"

#include <cctype>

#include "engine/options/option_table.h"

namespace seamflow {

namespace {

struct Exchange {
    std::string_view from;
    std::string_view to;
};

/// Values of fields.
constexpr Exchange named_values[] = {{"Approach::Sweep", "--approach sweep"}, {"Filter::LowPass", "--filter low-pass"}};

bool is_of_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:").find(c) != std::string_view::npos;
}

/// Whether text[begin, end) is not part of a longer name, for instance of a file. A colon, a full stop or a blank may
/// follow.
bool stands_alone(std::string_view text, std::size_t begin, std::size_t end)
{
    if (begin > 0 && is_of_word(text[begin - 1]))
        return false;
    if (end == text.size() || !is_of_word(text[end]))
        return true;
    return (text[end] == ':' || text[end] == '.') && (end + 1 == text.size() || text[end + 1] == ' ');
}

/// Only where it stands alone.
void exchange(std::string& text, std::string_view word, std::string_view option)
{
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (stands_alone(text, at, at + word.size()))
            text.replace(at, word.size(), option);
}

}  // namespace

std::string in_words_of_options(std::string_view message)
{
    const std::string_view first = message.substr(0, message.find(' '));
    std::string text(message);
    for (const OptionTraits& known : all_options()) {
        if (known.option.empty())
            continue;
        if (known.field == first)
            text.replace(0, first.size(), known.option);
        if (known.field.find('_') != std::string_view::npos)
            exchange(text, known.field, known.option);
    }
    for (const auto& [value, option] : named_values)
        exchange(text, value, option);
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
