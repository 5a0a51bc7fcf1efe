#pragma once

#include <string>

namespace seamflow {

/// The page without its contents: one HTML file with all its scripts and styles, which contains "{{title}}" and
/// "{{data}}" once each. npm makes it from samples/page/src when the project is built.
/// @returns empty if the project was built without npm.
const std::string& page_template();

}  // namespace seamflow
