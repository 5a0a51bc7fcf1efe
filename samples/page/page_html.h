#pragma once

#include <span>
#include <string>

#include "samples/page/page_fields.h"
#include "samples/page/page_flow.h"

namespace seamflow {

/// A page for a browser that shows flows on one mesh: the surface step by step, coloured by measured values, and plots
/// of distances and times. It is self-contained: opening it loads nothing else.
/// @param title plain text, in any characters: the name of the input.
/// @param flows at least one, finished, all on the same mesh.
/// @throws OptionError (see require_page).
std::string page_html(const std::string& title, std::span<const PageFlow> flows);

/// As above, for fields on a surface that stays: it is coloured by one of them, before and after, on one scale.
std::string page_html(const std::string& title, const PageMesh& mesh, const PageFields& fields);

/// @throws OptionError saying what to install if this program was built without the page.
void require_page();

/// A text escaped for HTML, between tags or in quotation marks.
std::string escaped_for_html(std::string text);

}  // namespace seamflow
