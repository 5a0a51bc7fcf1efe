#include "samples/process/option_words.h"

#include <algorithm>
#include <cctype>

#include "engine/options/option_table.h"

namespace seamflow {

namespace {

bool is_of_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:").find(c) != std::string_view::npos;
}

}  // namespace

std::string option_of_program(std::string_view option, std::string_view value)
{
    if (option == "denoise")
        return "--preset automatic";
    const auto known = std::ranges::find(all_options(), option, &OptionTraits::field);
    std::string name(option);
    if (known != all_options().end() && !known->option.empty())
        name = known->option;
    else if (known == all_options().end() && !option.starts_with("--"))
        std::ranges::replace(name.insert(0, "--"), '_', '-');
    return option_of_library(name, value);
}

std::vector<RemarkInWords> in_words_of_program(const std::vector<Remark>& remarks)
{
    std::vector<RemarkInWords> list;
    for (const Remark& remark : remarks)
        list.push_back({remark.kind, remark.numbers, sentence(remark, option_of_program)});
    return list;
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
