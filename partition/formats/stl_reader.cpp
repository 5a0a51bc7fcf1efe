#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/stl.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

// A binary file: a title, the number of facets, and for each facet its normal, three corners, and an attribute.
constexpr std::size_t title_bytes = 80;
constexpr std::size_t header_bytes = title_bytes + 4;
constexpr std::size_t normal_bytes = 12;
constexpr std::size_t attribute_bytes = 2;
constexpr std::size_t facet_bytes = normal_bytes + 36 + attribute_bytes;

using Corner = std::array<double, 3>;

/// Compares with a keyword in lower case.
bool is_keyword(std::string_view token, std::string_view keyword)
{
    return std::equal(token.begin(), token.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

std::uint64_t declared_facets(std::string_view file)
{
    return from_bytes<std::uint32_t>(file.data() + title_bytes, std::endian::little);
}

/// Mixes the bits of the coordinates: multiplication carries them up, the shift brings them down again.
std::size_t hash_of(const Corner& point)
{
    std::uint64_t result = 0;
    for (const double x : point) {
        result = (result ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
        result ^= result >> 32U;
    }
    return static_cast<std::size_t>(result);
}

/// Joins the corners of facets to vertices, and facets to a mesh. Points with equal coordinates become the same vertex,
/// numbered in the order in which they first appear. Positive and negative zero are equal; the vertex keeps the sign
/// that came first.
class FacetCollector {
  public:
    explicit FacetCollector(const InputPosition& position)
        : position_(position)
        , builder_(position)
        , slots_(1024, -1)
    {
    }

    void add(const std::array<Corner, 3>& points)
    {
        const std::array<Index, 3> corners = {vertex(points[0]), vertex(points[1]), vertex(points[2])};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            position_.fault("two corners of the facet have the same coordinates; remove the facet");
        else
            builder_.add_face(corners);
    }

    PolygonMesh finish() { return builder_.finish(); }

  private:
    Index vertex(const Corner& point);
    [[nodiscard]] std::size_t slot_of(const Corner& point) const;
    void grow();

    const InputPosition& position_;
    MeshBuilder builder_;
    /// The points of the vertices, zeros positive.
    std::vector<Corner> points_;
    /// A hash table with open addressing: vertices, or -1. Its length is a power of two.
    std::vector<Index> slots_;
};

/// The slot that holds the vertex at this point, or the free one where it belongs.
std::size_t FacetCollector::slot_of(const Corner& point) const
{
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(point) & mask;
    while (slots_[slot] >= 0 && points_[static_cast<std::size_t>(slots_[slot])] != point)
        slot = (slot + 1) & mask;
    return slot;
}

void FacetCollector::grow()
{
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t v = 0; v < points_.size(); ++v)
        slots_[slot_of(points_[v])] = static_cast<Index>(v);
}

/// The vertex at that point.
Index FacetCollector::vertex(const Corner& point)
{
    const Corner key = {point[0] + 0.0, point[1] + 0.0, point[2] + 0.0};
    const std::size_t slot = slot_of(key);
    if (slots_[slot] >= 0)
        return slots_[slot];
    const auto result = static_cast<Index>(points_.size());
    builder_.add_vertex(point);
    points_.push_back(key);
    slots_[slot] = result;
    if (2 * points_.size() > slots_.size())
        grow();
    return result;
}

class TextReader {
  public:
    TextReader(const std::filesystem::path& path, std::string_view text, FaultLog* faults)
        : scanner_(path, text, {.comment = '\0'})
        , collector_(scanner_)
    {
        scanner_.note_faults_in(faults);
    }

    PolygonMesh read()
    {
        while (scanner_.next_line())
            read_solid();
        return collector_.finish();
    }

  private:
    void read_solid();
    void read_facet();
    Corner read_corner();
    void next_line(std::string_view keyword);
    void expect(std::string_view keyword);

    TextScanner scanner_;
    FacetCollector collector_;
};

void TextReader::read_solid()
{
    expect("solid");
    next_line("facet or endsolid");
    while (!is_keyword(scanner_.peek(), "endsolid")) {
        expect("facet");
        read_facet();
        next_line("facet or endsolid");
    }
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
    expect("endloop");
    next_line("endfacet");
    expect("endfacet");
    collector_.add({a, b, c});
}

Corner TextReader::read_corner()
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

double read_coordinate(ByteScanner& scanner)
{
    const double value = scanner.read<float>();
    if (!std::isfinite(value))
        scanner.fault("a coordinate is not a finite number; remove the facet or mend it");
    return value;
}

Corner read_point(ByteScanner& scanner)
{
    const double x = read_coordinate(scanner);
    const double y = read_coordinate(scanner);
    const double z = read_coordinate(scanner);
    return {x, y, z};
}

void require_room_for_facets(ByteScanner& scanner, std::string_view file)
{
    if (file.size() < header_bytes)
        scanner.fail("this is neither text STL, which begins with the word solid, nor binary STL, which has at least "
                     "84 bytes; export the mesh again");
    const std::uint64_t n = declared_facets(file);
    if (n > (file.size() - header_bytes) / facet_bytes)
        scanner.fail(fmt::format("the file announces {}, but its {} bytes hold only {}; it has been cut off or is no "
                                 "STL file: export or copy the mesh again",
                                 counted(n, "facet", "facets"), file.size(),
                                 (file.size() - header_bytes) / facet_bytes));
}

PolygonMesh read_binary(const std::filesystem::path& path, std::string_view file, FaultLog* faults)
{
    ByteScanner scanner(path, file, std::min(title_bytes, file.size()), std::endian::little);
    scanner.note_faults_in(faults);
    require_room_for_facets(scanner, file);
    FacetCollector collector(scanner);
    const auto n = scanner.read<std::uint32_t>();
    for (std::uint64_t f = 0; f < n; ++f) {
        scanner.enter("facet", f);
        scanner.take(normal_bytes);
        const Corner a = read_point(scanner);
        const Corner b = read_point(scanner);
        const Corner c = read_point(scanner);
        scanner.take(attribute_bytes);
        collector.add({a, b, c});
    }
    scanner.require_end();
    return collector.finish();
}

bool is_text_stl(std::string_view file)
{
    if (file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * declared_facets(file))
        return false;
    TextScanner scanner({}, file.substr(0, 1024));
    const bool solid = scanner.next_line() && is_keyword(scanner.token(), "solid");
    return solid && file.substr(0, 1024).find('\0') == std::string_view::npos;
}

}  // namespace

MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing&, FaultLog* faults)
{
    if (is_text_stl(file))
        return {TextReader(path, file, faults).read(), {FileFormat::Stl, Encoding::Ascii}};
    return {read_binary(path, file, faults), {FileFormat::Stl, Encoding::BinaryLittleEndian}};
}

}  // namespace seamflow
