#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "partition/io/text_scanner.h"

/// The grammar of text STL.
namespace seamflow {

inline constexpr TextSyntax stl_syntax = {.comment = '\0'};

/// Whether a token is a keyword, in letters of either case.
/// @param keyword in lower case.
bool is_keyword(std::string_view token, std::string_view keyword);

/// Goes to the next line. @param keyword with which it should begin, for the message.
/// @throws InputError if there is none.
void next_stl_line(TextScanner& scanner, std::string_view keyword);

/// Passes over a keyword.
/// @throws InputError if there is something else.
void pass_over_keyword(TextScanner& scanner, std::string_view keyword);

/// Whether the line ends `what`: some programs write "end loop" for "endloop".
bool is_end_of(TextScanner& scanner, std::string_view what);

/// Skips the lines after the corners of a facet, up to its end.
/// @throws InputError if there are more corners, or other words.
void end_stl_facet(TextScanner& scanner);

/// Checks that the line of a corner ends here.
/// @throws InputError if it continues.
void end_stl_corner(TextScanner& scanner);

/// Scans a text, or a slice of it (see stl_slices_at_facets). The visitor has those of the following functions that it
/// needs:
/// - solid(scanner): reads the line `solid`, beginning at the name;
/// - normal(scanner): reads the line `facet`, beginning at the word `normal`;
/// - corner(k, scanner): must read the three coordinates of a corner;
/// - facet(): called when a facet has been read.
/// @param in_solid whether the text begins within a solid. @returns whether it ends within one.
template <class Visitor>
bool scan_text_stl(TextScanner& scanner, bool in_solid, Visitor& visitor)
{
    while (scanner.next_line()) {
        if (!in_solid) {
            pass_over_keyword(scanner, "solid");
            if constexpr (requires { visitor.solid(scanner); })
                visitor.solid(scanner);
            in_solid = true;
        } else if (is_end_of(scanner, "solid")) {
            in_solid = false;
        } else if (!is_keyword(scanner.peek(), "color")) {
            pass_over_keyword(scanner, "facet");
            if constexpr (requires { visitor.normal(scanner); })
                visitor.normal(scanner);
            next_stl_line(scanner, "outer loop");
            pass_over_keyword(scanner, "outer");
            pass_over_keyword(scanner, "loop");
            for (std::size_t k = 0; k < 3; ++k) {
                next_stl_line(scanner, "vertex");
                pass_over_keyword(scanner, "vertex");
                if constexpr (requires { visitor.corner(k, scanner); }) {
                    visitor.corner(k, scanner);
                    end_stl_corner(scanner);
                }
            }
            end_stl_facet(scanner);
            if constexpr (requires { visitor.facet(); })
                visitor.facet();
        }
    }
    return in_solid;
}

/// Divides a text into slices that begin at facets, except for the first slice.
std::vector<std::string_view> stl_slices_at_facets(const TextScanner& whole, std::size_t bytes);

}  // namespace seamflow
