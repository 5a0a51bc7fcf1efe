#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "partition/io/text_scanner.h"
#include "partition/vector_area.h"

/// Vertices in lines of text: the common part of the scans of OBJ and OFF.
namespace seamflow {

/// Three numbers of a line, with their texts.
struct WrittenNumbers {
    std::array<std::string_view, 3> parts;
    Point values;
};

/// The numbers after the coordinates of a vertex: perhaps a normal, then the numbers of a colour.
struct VertexLayout {
    bool has_normal = false;
    /// The number of numbers after the colour.
    Index n_behind_colour = 0;
};

/// Visits the numbers of a vertex. The visitor has those of the following functions that it needs:
/// - position(v, scanner): reads the three coordinates;
/// - normal(v, scanner): reads the three numbers of the normal;
/// - colour(v, scanner, n_behind): reads the rest of the line, whose last n_behind numbers are no colour.
/// @param scanner before the coordinates. If line ends count as blanks, it is moved past the vertex, which then has no
/// colour.
template <class Visitor>
void scan_vertex(TextScanner& scanner, Index v, const VertexLayout& layout, Visitor& visitor)
{
    constexpr bool visits_colour = requires
    {
        visitor.colour(v, scanner, std::size_t{});
    };
    // Numbers are passed over only if something after them is read.
    const bool goes_on = visits_colour || scanner.crosses_lines();
    const auto pass_over = [&](Index n) {
        for (; goes_on && n > 0; --n)
            scanner.token();
    };
    if constexpr (requires { visitor.position(v, scanner); })
        visitor.position(v, scanner);
    else
        pass_over(3);
    if (layout.has_normal) {
        if constexpr (requires { visitor.normal(v, scanner); })
            visitor.normal(v, scanner);
        else
            pass_over(3);
    }
    if (scanner.crosses_lines())
        pass_over(layout.n_behind_colour);
    else if constexpr (visits_colour)
        visitor.colour(v, scanner, usize(layout.n_behind_colour));
}

}  // namespace seamflow
