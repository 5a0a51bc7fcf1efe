#pragma once

#include <string>

namespace seamflow {

/// The page without what it shows: one HTML file with all its scripts and styles, in which "{{title}}" and "{{data}}"
/// stand once each. It is made from samples/page/src by npm when the project is built.
/// @returns empty: the project was built without npm.
const std::string& page_template();

}  // namespace seamflow
