#pragma once

#include <string>
#include <string_view>

/// The library refers to settings by fields of FlowOptions, the command line by options, Python by keywords.
namespace seamflow {

/// Replaces fields in a message of the library by the options that set them: "memory_limit is 3" becomes
/// "--memory-limit is 3". A field of one word is only recognised where the message begins with it.
std::string in_words_of_options(std::string_view message);

/// Replaces options in a message by keywords: "--time-step-edges" becomes "time_step_edges".
std::string in_words_of_keywords(std::string_view message);

}  // namespace seamflow
