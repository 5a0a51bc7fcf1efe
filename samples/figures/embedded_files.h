#pragma once

#include <string_view>

namespace seamflow {

/// The files draw.py and index_head.html of samples/figures, which are a part of the program.
std::string_view draw_script();
std::string_view index_head();

}  // namespace seamflow
