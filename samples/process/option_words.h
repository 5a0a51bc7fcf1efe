#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "partition/remark.h"

/// The library refers to settings by fields of FlowOptions, the command line by options, Python by keywords.
namespace seamflow {

/// How command lines write an option of the library: "--radius", "--boundary free".
/// @param option a field of FlowOptions, or an option that has the same name on command lines. @param value may be
/// empty.
std::string option_of_program(std::string_view option, std::string_view value);

/// A remark in the words of command lines.
struct RemarkInWords {
    std::string kind;
    Remark::Numbers numbers;
    std::string text;
};

std::vector<RemarkInWords> in_words_of_program(const std::vector<Remark>& remarks);

/// Replaces options in a message by keywords: "--time-step-edges" becomes "time_step_edges".
std::string in_words_of_keywords(std::string_view message);

}  // namespace seamflow
