#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_file.h"
#include "partition/formats/stl.h"
#include "partition/formats/stl_facets.h"
#include "partition/formats/stl_scan.h"

namespace seamflow {

bool is_keyword(std::string_view token, std::string_view keyword)
{
    return std::equal(token.begin(), token.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

void next_stl_line(TextScanner& scanner, std::string_view keyword)
{
    if (!scanner.next_line())
        scanner.fail("the file ends where {} should follow; it has been cut off: export or copy the mesh again",
                     in_quotes(keyword));
}

void pass_over_keyword(TextScanner& scanner, std::string_view keyword)
{
    const auto token = scanner.token();
    if (!is_keyword(token, keyword))
        scanner.fail("expected {}, but found {}; correct the line or export the mesh again", in_quotes(keyword),
                     token.empty() ? "the end of the line" : in_quotes(token));
}

bool is_end_of(TextScanner& scanner, std::string_view what)
{
    const std::string_view token = scanner.peek();
    if (token.size() < 3 || !is_keyword(token.substr(0, 3), "end"))
        return false;
    if (token.size() > 3)
        return is_keyword(token.substr(3), what);
    TextScanner ahead = scanner;
    ahead.token();
    return is_keyword(ahead.token(), what);
}

void end_stl_facet(TextScanner& scanner)
{
    next_stl_line(scanner, "endloop");
    if (is_keyword(scanner.peek(), "vertex"))
        scanner.fail("the facet has more than 3 corners, but STL holds triangles only; export the mesh as " +
                     extensions_of(FormatGroup::Polygons));
    if (!is_end_of(scanner, "loop"))
        pass_over_keyword(scanner, "endloop");
    next_stl_line(scanner, "endfacet");
    if (!is_end_of(scanner, "facet"))
        pass_over_keyword(scanner, "endfacet");
}

void end_stl_corner(TextScanner& scanner)
{
    if (scanner.has_token())
        scanner.fail("expected the end of the line after the three coordinates, but found {}; put each vertex on a "
                     "line of its own",
                     in_quotes(scanner.peek()));
}

std::vector<std::string_view> stl_slices_at_facets(const TextScanner& whole, std::size_t bytes)
{
    std::vector<std::string_view> slices;
    const char* const end = whole.rest().data() + whole.rest().size();
    const auto slice_between = [](const char* first, const char* last) {
        return std::string_view(first, static_cast<std::size_t>(last - first));
    };
    const char* begin = whole.rest().data();
    // Each slice is extended up to the next line that begins with `facet`.
    for (const std::string_view slice : whole.slices(bytes)) {
        TextScanner scanner(whole, slice_between(slice.data() + slice.size(), end));
        const char* line = scanner.rest().data();
        while (scanner.next_line() && !is_keyword(scanner.peek(), "facet"))
            line = scanner.rest().data();
        if (scanner.rest().empty())
            line = end;
        if (line > begin)
            slices.push_back(slice_between(begin, line));
        begin = std::max(begin, line);
    }
    return slices;
}

namespace {

/// A visitor for scan_text_stl that adds each facet to a collector.
struct TextFacetReader {
    FacetCollector<double>& collector;
    std::array<FacetCollector<double>::Corner, 3> corners = {};

    void corner(std::size_t k, TextScanner& scanner) { corners[k] = scanner.coordinates(); }
    void facet() { collector.add(corners); }
};

/// Reads the mesh from the slices of a text.
/// @param faults if not null, collects faults instead of throwing; null if there are several slices.
/// @throws InputError for a fault that `faults` does not collect; the message names it if there is one slice.
PolygonMesh read_text_slices(const TextScanner& whole, std::span<const std::string_view> slices, const Executor& exec,
                             FaultLog* faults)
{
    const auto n = static_cast<Index>(slices.size());
    return join_facets<double>(n, exec, [&](Index i, const MeshSlice& mesh_slice) {
        TextScanner scanner(whole, slices[i]);
        scanner.note_faults_in(faults);
        FacetCollector<double> collector(scanner, mesh_slice);
        TextFacetReader reader{collector};
        const bool is_open = scan_text_stl(scanner, i > 0, reader);
        if (is_open && i + 1 == n)
            next_stl_line(scanner, "facet or endsolid");
        // The next slice is read as if it began within a solid.
        if (!is_open && i + 1 < n)
            throw InputError("a solid ends too early");
        return collector.take_points(n == 1);
    });
}

}  // namespace

PolygonMesh read_text_stl(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults)
{
    const TextScanner whole(path, text, stl_syntax);
    const std::vector<std::string_view> slices = stl_slices_at_facets(whole, slicing.bytes);
    const auto in_one_go = [&] { return read_text_slices(whole, std::array{whole.rest()}, run_serially, faults); };
    if (slices.size() < 2)
        return in_one_go();
    return read_in_slices_if_faultless([&] { return read_text_slices(whole, slices, slicing.exec, nullptr); },
                                       in_one_go);
}

}  // namespace seamflow
