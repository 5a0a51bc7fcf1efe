#pragma once

#include <string>
#include <string_view>

/// The library names what it is about by fields of FlowOptions, the command line by options, Python by keywords.
namespace seamflow {

/// What the library says of fields, said of the options that set them: "memory_limit is 3" becomes "--memory-limit is
/// 3". A field of one word is taken for one where the message begins with it, or where it tells flows apart ("another
/// flow: sweep was …").
std::string in_words_of_options(std::string_view message);

/// What is said of options, said of keywords: "--time-step-edges" becomes "time_step_edges".
std::string in_words_of_keywords(std::string_view message);

}  // namespace seamflow
