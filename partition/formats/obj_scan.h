#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "partition/executor.h"
#include "partition/formats/text_vertices.h"
#include "partition/index.h"
#include "partition/io/plain_line.h"
#include "partition/io/text_scanner.h"

/// The grammar of Wavefront OBJ.
namespace seamflow {

inline constexpr TextSyntax obj_syntax = {.comment = '#', .continuation = true};

/// The numbers of lines `v` and `vn` up to a position in a file.
struct ObjCounts {
    std::int64_t n_vertices = 0;
    std::int64_t n_normals = 0;

    friend bool operator==(const ObjCounts&, const ObjCounts&) = default;
};

/// A corner of a face or polyline, as written in the file.
struct ObjCorner {
    /// The number of the vertex, from 1; a negative number counts back from the line.
    std::int64_t vertex;
    /// The text after the vertex, as in 7/1, 7//2 or 7/1/2; any text is allowed.
    std::string_view attributes;
};

/// Reads the next corner of the line. @param what the corner that is expected, in words for the message.
/// @throws InputError if it does not begin with a whole number.
ObjCorner read_obj_corner(TextScanner& scanner, const char* what);

/// "names vertex -3, counted back …": the complaint about a vertex before the first.
/// @param n number of vertices before the line. @param remedy what to do.
std::string counted_back_too_far(std::int64_t vertex, std::int64_t n, const char* remedy);

/// A visitor without functions, which only counts.
struct ObjCounter {};

/// Whether a line that begins with this word describes a face.
inline bool is_obj_face(std::string_view keyword)
{
    return keyword.starts_with('f') && (keyword.size() == 1 || keyword == "fo");
}

/// Scans the next line if it is a vertex or, for visitors of faces, a face in the commonest form, without fault; see
/// scan_obj.
/// @param corners scratch. @returns whether it was such a line.
template <class Visitor>
bool scan_plain_obj_line(TextScanner& scanner, Visitor& visitor, ObjCounts& counts, std::vector<Index>& corners)
{
    WrittenNumbers numbers;
    if (scanner.next_plain_line([&](PlainLine& line) {
            const auto number = [&](Index k) { return line.real(numbers.values[k], numbers.parts[usize(k)]); };
            return line.keyword('v') && number(0) && number(1) && number(2) && line.ends();
        })) {
        visitor.plain_vertex(static_cast<Index>(counts.n_vertices), numbers);
        ++counts.n_vertices;
        return true;
    }
    if constexpr (requires { visitor.plain_face(corners); }) {
        corners.clear();
        const bool is_face = scanner.next_plain_line([&](PlainLine& line) {
            bool goes_on = line.keyword('f');
            for (std::uint64_t number = 0; goes_on && !line.ends(); corners.push_back(static_cast<Index>(number - 1)))
                goes_on = line.corner(number) && number > 0 && number <= static_cast<std::uint64_t>(counts.n_vertices);
            return goes_on;
        });
        if (is_face)
            visitor.plain_face(corners);
        return is_face;
    }
    return false;
}

/// Scans a file, or a slice of it, with a TextScanner. The visitor has those of the following functions that it needs,
/// besides those of scan_vertex for lines `v`:
/// - normal(n, scanner): reads the n-th line `vn`, beginning at its first number;
/// - face(scanner, counts): reads a face, beginning at its first corner; `counts` are those before the line;
/// - line(scanner, counts): reads a polyline in the same way;
/// - other(keyword): gets the keyword of any other statement;
/// - plain_vertex(v, coordinates) and perhaps plain_face(vertices): get vertices, and faces that name only vertices
///    before them, from lines in the commonest form; the functions above then get the other lines only.
/// @param counts before the slice. @param end the counts before the next slice, for a visitor of vertices and normals
/// alone: the scan ends after the last of them.
/// @returns the counts at the end.
template <class Visitor>
ObjCounts scan_obj(auto&& scanner, Visitor& visitor, ObjCounts counts = {}, const ObjCounts& end = {-1, -1})
{
    constexpr bool counts_alone = std::is_same_v<Visitor, ObjCounter>;
    std::vector<Index> corners;
    while (counts != end) {
        if constexpr (requires { visitor.plain_vertex(Index{}, WrittenNumbers()); })
            if (scan_plain_obj_line(scanner, visitor, counts, corners))
                continue;
        const std::string_view keyword = counts_alone          ? scanner.next_keyword()
                                         : scanner.next_line() ? scanner.token()
                                                               : std::string_view();
        if (keyword.empty())
            break;
        if (keyword == "v") {
            scan_vertex(scanner, static_cast<Index>(counts.n_vertices), {}, visitor);
            ++counts.n_vertices;
        } else if (keyword == "vn") {
            if constexpr (requires { visitor.normal(Index{}, scanner); })
                visitor.normal(static_cast<Index>(counts.n_normals), scanner);
            ++counts.n_normals;
        } else if (is_obj_face(keyword)) {
            if constexpr (requires { visitor.face(scanner, counts); })
                visitor.face(scanner, counts);
        } else if (keyword == "l") {
            if constexpr (requires { visitor.line(scanner, counts); })
                visitor.line(scanner, counts);
        } else if constexpr (requires { visitor.other(keyword); }) {
            visitor.other(keyword);
        }
    }
    return counts;
}

/// The counts before each slice of a file and, at the end, of the whole file.
/// @throws InputError if there are more than 2^31 - 1 of a kind.
std::vector<ObjCounts> count_obj(const TextScanner& whole, std::span<const std::string_view> slices,
                                 const Executor& exec);

}  // namespace seamflow
