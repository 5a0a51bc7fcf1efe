#include "partition/formats/off_header.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

namespace seamflow {

namespace {

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Checks that the prefix consists of ST, C and N, each once at most.
void require_known_variant(const TextScanner& scanner, std::string_view prefix)
{
    if (prefix.find_first_of("4n") != std::string_view::npos)
        scanner.fail(
            "{} files, whose vertices do not have just three coordinates, cannot be read; convert the mesh to OFF",
            in_quotes(std::string(prefix) + "OFF"));
    constexpr std::array<std::string_view, 3> parts = {"ST", "C", "N"};
    std::array<int, 3> n_found{};
    std::string_view left = prefix;
    for (bool goes_on = true; goes_on && !left.empty();) {
        goes_on = false;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (left.starts_with(parts[i]) && n_found[i]++ == 0) {
                left.remove_prefix(parts[i].size());
                goes_on = true;
            }
    }
    if (!left.empty())
        scanner.fail("the keyword {} is unknown; convert the mesh to OFF, COFF or NOFF",
                     in_quotes(std::string(prefix) + "OFF"));
}

/// Reads the keyword OFF with its prefix. Counts may follow OFF without a blank.
/// @returns the prefix before OFF; empty, and nothing is read, if the file begins with its counts.
std::string_view read_keyword(TextScanner& scanner)
{
    if (!scanner.next_line())
        scanner.fail("the file holds no mesh, only comments or blanks; export the mesh again");
    const auto word = scanner.peek();
    if (std::all_of(word.begin(), word.end(), is_digit))
        return {};
    const auto off = word.find("OFF");
    if (off == std::string_view::npos || (word.size() > off + 3 && !is_digit(word[off + 3])))
        scanner.fail(
            "the file begins with {} and not with OFF; if it has another format, give it that format's extension",
            in_quotes(word));
    const std::string_view prefix = word.substr(0, off);
    require_known_variant(scanner, prefix);
    scanner.skip(off + 3);
    if (scanner.peek() == "BINARY")
        scanner.fail(
            "binary OFF files with more than coordinates and faces cannot be read; convert the mesh to text OFF "
            "or to PLY");
    return prefix;
}

/// Reads a number of elements, and checks that the file can hold so many.
/// @param size of the file, in bytes. @param shortest_line the fewest characters in which a vertex or a face can be
/// written, with the line end.
std::int64_t read_count(TextScanner& scanner, std::int64_t size, const char* what, std::int64_t shortest_line)
{
    const std::int64_t n = scanner.integer(what);
    if (n < 0 || n > (size + 1) / shortest_line)
        scanner.fail("{} is {}, but a file of {} bytes cannot hold so many; correct the header, or export "
                     "the mesh again if it was cut off",
                     what, n, size);
    return n;
}

}  // namespace

std::optional<std::size_t> start_of_binary_off(std::string_view content)
{
    const std::string_view line = content.substr(0, content.find('\n'));
    const auto second = line.find_first_not_of(" \t", 3);
    if (!line.starts_with("OFF") || second == 3 || second == std::string_view::npos ||
        !line.substr(second).starts_with("BINARY") || line.size() == content.size())
        return std::nullopt;
    return line.size() + 1;
}

OffHeader read_off_header(TextScanner& scanner)
{
    const auto size = static_cast<std::int64_t>(scanner.rest().size());
    OffHeader header;
    header.prefix = read_keyword(scanner);
    if (!scanner.has_token() && !scanner.next_line())
        scanner.fail("the file ends before the numbers of vertices and faces; export the mesh again");
    // The shortest lines are "0 0 0" for a vertex and "1 0" for a face, each with a line end.
    header.n_vertices = read_count(scanner, size, "the number of vertices", 6);
    header.n_faces = read_count(scanner, size, "the number of faces", 4);
    if (scanner.has_token())
        scanner.integer("the number of edges");
    if (scanner.has_token() && !scanner.crosses_lines())
        scanner.fail("expected the end of the line after the numbers of vertices, faces and edges, but found {}; "
                     "correct the header",
                     in_quotes(scanner.peek()));
    return header;
}

}  // namespace seamflow
