#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_file.h"
#include "partition/formats/stl.h"
#include "partition/formats/stl_facets.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"
#include "partition/point_numbers.h"

namespace seamflow {

namespace {

/// Reads a whole file, or a slice of one.
class TextReader {
  public:
    TextReader(const TextScanner& scanner, FaultLog* faults)
        : scanner_(scanner)
        , collector_(scanner_)
    {
        scanner_.note_faults_in(faults);
    }

    TextReader(const TextScanner& scanner, const MeshSlice& slice)
        : scanner_(scanner)
        , collector_(scanner_, slice)
    {
    }

    /// @param in_solid whether the first line is within a solid. @param end where the last line to be read begins, at
    /// most.
    /// @returns whether a solid is still open.
    bool read(bool in_solid, const char* end);

    /// @throws InputError within a solid.
    void require_end(bool in_solid)
    {
        if (in_solid)
            next_line("facet or endsolid");
    }

    FacetCollector<double>& collector() { return collector_; }

  private:
    using Corner = FacetCollector<double>::Corner;

    void read_facet();
    Corner read_corner();
    void next_line(std::string_view keyword);
    void expect(std::string_view keyword);
    bool is_end_of(std::string_view what);
    void expect_end_of(std::string_view what);

    TextScanner scanner_;
    FacetCollector<double> collector_;
};

bool TextReader::read(bool in_solid, const char* end)
{
    while (scanner_.next_line() && scanner_.peek().data() < end) {
        if (!in_solid) {
            expect("solid");
            in_solid = true;
        } else if (is_end_of("solid")) {
            in_solid = false;
        } else if (!is_keyword(scanner_.peek(), "color")) {
            expect("facet");
            read_facet();
        }
    }
    return in_solid;
}

void TextReader::read_facet()
{
    next_line("outer loop");
    expect("outer");
    expect("loop");
    const Corner a = read_corner();
    const Corner b = read_corner();
    const Corner c = read_corner();
    next_line("endloop");
    if (is_keyword(scanner_.peek(), "vertex"))
        scanner_.fail("the facet has more than 3 corners, but STL holds triangles only; export the mesh as " +
                      extensions_of(FormatGroup::Polygons));
    expect_end_of("loop");
    next_line("endfacet");
    expect_end_of("facet");
    collector_.add({a, b, c});
}

TextReader::Corner TextReader::read_corner()
{
    next_line("vertex");
    expect("vertex");
    const Corner position = scanner_.coordinates();
    if (scanner_.has_token())
        scanner_.fail("expected the end of the line after the three coordinates, but found " +
                      in_quotes(scanner_.peek()) + "; put each vertex on a line of its own");
    return position;
}

void TextReader::next_line(std::string_view keyword)
{
    if (!scanner_.next_line())
        scanner_.fail("the file ends where " + in_quotes(keyword) +
                      " should follow; it has been cut off: export or copy the mesh again");
}

void TextReader::expect(std::string_view keyword)
{
    const auto token = scanner_.token();
    if (!is_keyword(token, keyword))
        scanner_.fail(fmt::format("expected {}, but found {}; correct the line or export the mesh again",
                                  in_quotes(keyword), token.empty() ? "the end of the line" : in_quotes(token)));
}

/// Some programs write "end loop" for "endloop".
bool TextReader::is_end_of(std::string_view what)
{
    if (is_keyword(scanner_.peek(), "end" + std::string(what)))
        return true;
    if (!is_keyword(scanner_.peek(), "end"))
        return false;
    TextScanner ahead = scanner_;
    ahead.token();
    return is_keyword(ahead.token(), what);
}

void TextReader::expect_end_of(std::string_view what)
{
    if (!is_end_of(what))
        expect("end" + std::string(what));
}

const char* end_of(std::string_view text)
{
    return text.data() + text.size();
}

}  // namespace

std::vector<std::string_view> stl_slices_at_facets(const TextScanner& whole, std::size_t bytes)
{
    std::vector<std::string_view> slices;
    const char* const end = whole.rest().data() + whole.rest().size();
    const auto slice_between = [](const char* first, const char* last) {
        return std::string_view(first, static_cast<std::size_t>(last - first));
    };
    const char* begin = whole.rest().data();
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

PolygonMesh read_text_stl(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults)
{
    const TextScanner whole(path, text, {.comment = '\0'});
    const char* const begin = whole.rest().data();
    const char* const end = end_of(whole.rest());
    const auto in_one_go = [&] {
        TextReader reader(whole, faults);
        reader.require_end(reader.read(false, end));
        return reader.collector().finish();
    };
    if (text.size() <= slicing.bytes)
        return in_one_go();
    const auto in_slices = [&] {
        const std::vector<std::string_view> slices = stl_slices_at_facets(whole, slicing.bytes);
        const auto read = [&](Index i, const MeshSlice& place) {
            TextReader reader(TextScanner(whole, slices[i]), place);
            const bool is_last = end_of(slices[i]) == end;
            if (reader.read(slices[i].data() != begin, end_of(slices[i])) == is_last)
                throw InputError("a solid ends too early, or does not end");
            return reader.collector().take_points();
        };
        PolygonMesh mesh;
        set_vertices(mesh, join_facets<double>(static_cast<Index>(slices.size()), slicing.exec, read, mesh));
        return mesh;
    };
    return read_in_slices_if_faultless(in_slices, in_one_go);
}

}  // namespace seamflow
