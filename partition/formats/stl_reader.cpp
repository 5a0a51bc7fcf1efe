#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/stl.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"
#include "partition/point_numbers.h"

namespace seamflow {

namespace {

// A binary file: a title, the number of facets, and for each facet its normal, three corners, and an attribute.
constexpr std::size_t title_bytes = 80;
constexpr std::size_t header_bytes = title_bytes + 4;
constexpr std::size_t normal_bytes = 12;
constexpr std::size_t attribute_bytes = 2;
constexpr std::size_t facet_bytes = normal_bytes + 36 + attribute_bytes;

using Corner = PointNumbers::Place;

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

/// Joins the corners of facets to vertices, and facets to a mesh.
class FacetCollector {
  public:
    /// Of a whole file.
    explicit FacetCollector(const InputPosition& position)
        : position_(position)
        , builder_(position)
    {
    }

    /// Of a slice, whose vertices are the points in it.
    /// @param slice without vertices.
    FacetCollector(const InputPosition& position, const MeshSlice& slice)
        : position_(position)
        , builder_(position, 0, slice)
    {
    }

    void add(const std::array<Corner, 3>& points)
    {
        const Index number = n_facets_++;
        if (points[0] == points[1] || points[1] == points[2] || points[2] == points[0]) {
            position_.harmless_fault("two corners of the facet have the same coordinates; remove the facet");
            position_.leave_out_face(number);
            return;
        }
        const std::array<Index, 3> corners = {numbers_(points[0]), numbers_(points[1]), numbers_(points[2])};
        builder_.add_face(corners);
    }

    [[nodiscard]] PointNumbers take_points() { return std::move(numbers_); }

    PolygonMesh finish()
    {
        for (const Corner& point : numbers_.points())
            builder_.add_vertex(point);
        return builder_.finish();
    }

  private:
    const InputPosition& position_;
    MeshBuilder builder_;
    PointNumbers numbers_;
    Index n_facets_ = 0;
};

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

    /// @param begins_in_solid, ends_in_solid for slices that do.
    void read(bool begins_in_solid = false, bool ends_in_solid = false);

    FacetCollector& collector() { return collector_; }

  private:
    void read_facet();
    Corner read_corner();
    void next_line(std::string_view keyword);
    void expect(std::string_view keyword);

    TextScanner scanner_;
    FacetCollector collector_;
};

void TextReader::read(bool begins_in_solid, bool ends_in_solid)
{
    bool in_solid = begins_in_solid;
    while (scanner_.next_line()) {
        if (!in_solid) {
            expect("solid");
            in_solid = true;
        } else if (is_keyword(scanner_.peek(), "endsolid")) {
            in_solid = false;
        } else {
            expect("facet");
            read_facet();
        }
    }
    if (in_solid != ends_in_solid)
        next_line("facet or endsolid");
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

void read_facets(ByteScanner& scanner, std::uint64_t begin, std::uint64_t end, FacetCollector& collector)
{
    for (std::uint64_t f = begin; f < end; ++f) {
        scanner.enter("facet", f);
        scanner.take(normal_bytes);
        const Corner a = read_point(scanner);
        const Corner b = read_point(scanner);
        const Corner c = read_point(scanner);
        scanner.take(attribute_bytes);
        collector.add({a, b, c});
    }
}

PolygonMesh read_binary(const std::filesystem::path& path, std::string_view file, FaultLog* faults)
{
    ByteScanner scanner(path, file, std::min(title_bytes, file.size()), std::endian::little);
    scanner.note_faults_in(faults);
    require_room_for_facets(scanner, file);
    FacetCollector collector(scanner);
    read_facets(scanner, 0, scanner.read<std::uint32_t>(), collector);
    scanner.require_end();
    return collector.finish();
}

/// Reads slices several at a time. The points of a slice become vertices of its own, and these those of the mesh.
/// @param read called with a slice and where its faces belong; gives its points.
PolygonMesh read_slices(Index n_slices, const Loop& loop,
                        const std::function<PointNumbers(Index slice, const MeshSlice& place)>& read)
{
    PolygonMesh mesh;
    PointNumbers numbers;
    std::vector<PointNumbers> of_slice(at(n_slices));
    Points none(0, 3);
    append_faces(
        mesh, n_slices, loop,
        [&](Index i, PolygonMesh& faces) {
            of_slice[i] = read(i, {none, 0, faces});
        },
        [&](Index i, PolygonMesh& faces) {
            std::vector<Index> number_of;
            for (const Corner& point : of_slice[i].points())
                number_of.push_back(numbers(point));
            for (Index& v : faces.face_vertices)
                v = number_of[v];
            of_slice[i] = {};
        });
    const auto n = static_cast<Index>(numbers.points().size());
    if (n == 0)
        throw InputError("no vertices");
    mesh.vertices = uninitialised_points(n);
    mesh.vertices = Eigen::Map<const Points>(numbers.points().data()->data(), n, 3);
    return mesh;
}

/// Slices of a text that begin at facets, but for the first.
std::vector<std::string_view> slices_at_facets(const TextScanner& whole, std::size_t bytes)
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

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_text_slices(const TextScanner& whole, const Slicing& slicing)
{
    const std::vector<std::string_view> slices = slices_at_facets(whole, slicing.bytes);
    const auto n = static_cast<Index>(slices.size());
    return read_slices(n, slicing.loop, [&](Index i, const MeshSlice& place) {
        TextReader reader(TextScanner(whole, slices[i]), place);
        reader.read(i > 0, i + 1 < n);
        return reader.collector().take_points();
    });
}

/// The same of a binary file.
PolygonMesh read_binary_slices(const std::filesystem::path& path, std::string_view file, const Slicing& slicing)
{
    ByteScanner all(path, file, title_bytes, std::endian::little);
    require_room_for_facets(all, file);
    const auto n = all.read<std::uint32_t>();
    const auto per_slice = static_cast<std::uint64_t>(elements_per_slice(slicing, facet_bytes));
    ByteScanner(path, file, header_bytes + facet_bytes * n, std::endian::little).require_end();
    return read_slices(static_cast<Index>((n + per_slice - 1) / per_slice), slicing.loop,
                       [&](Index i, const MeshSlice& place) {
                           const std::uint64_t begin = at(i) * per_slice;
                           ByteScanner scanner(path, file, header_bytes + facet_bytes * begin, std::endian::little);
                           FacetCollector collector(scanner, place);
                           read_facets(scanner, begin, std::min<std::uint64_t>(begin + per_slice, n), collector);
                           return collector.take_points();
                       });
}

bool has_size_of_binary(std::string_view file)
{
    return file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * declared_facets(file);
}

bool is_text_stl(std::string_view file)
{
    if (has_size_of_binary(file))
        return false;
    TextScanner scanner({}, file.substr(0, 1024));
    const bool solid = scanner.next_line() && is_keyword(scanner.token(), "solid");
    return solid && file.substr(0, 1024).find('\0') == std::string_view::npos;
}

}  // namespace

StlStretches::StlStretches(std::filesystem::path path, std::string_view content)
    : path_(std::move(path))
    , content_(content)
{
    if (is_text_stl(content))
        throw InputError(path_.string() +
                         ": the file is text, so that ranks cannot read it in slices; export it as a binary STL file");
    ByteScanner scanner(path_, content, std::min(title_bytes, content.size()), std::endian::little);
    require_room_for_facets(scanner, content);
    if (declared_facets(content) > std::uint64_t{std::numeric_limits<Index>::max()})
        throw InputError(
            fmt::format("{}: the file has {} facets, more than 2147483647; divide the mesh into several files",
                        path_.string(), declared_facets(content)));
    n_facets_ = static_cast<Index>(declared_facets(content));
}

std::string_view StlStretches::bytes(Index begin, Index end) const
{
    return content_.substr(header_bytes + facet_bytes * at(begin), facet_bytes * at(end - begin));
}

PointNumbers StlStretches::facets(Index begin, Index end, PolygonMesh& faces) const
{
    ByteScanner scanner(path_, content_, header_bytes + facet_bytes * at(begin), std::endian::little);
    Points none(0, 3);
    FacetCollector collector(scanner, {none, 0, faces});
    read_facets(scanner, at(begin), at(end), collector);
    return collector.take_points();
}

void StlStretches::require_end() const
{
    ByteScanner scanner(path_, content_, header_bytes + facet_bytes * at(n_facets_), std::endian::little);
    scanner.require_end();
    if (n_facets_ == 0)
        scanner.fail("the file has no vertices; export the mesh again");
}

bool is_stl(std::string_view file)
{
    return has_size_of_binary(file) || is_text_stl(file);
}

MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing& slicing, FaultLog* faults)
{
    const bool is_small = file.size() <= slicing.bytes;
    if (!is_text_stl(file)) {
        const auto in_one_go = [&] { return read_binary(path, file, faults); };
        return {is_small
                    ? in_one_go()
                    : read_in_slices_if_faultless([&] { return read_binary_slices(path, file, slicing); }, in_one_go),
                {FileFormat::Stl, Encoding::BinaryLittleEndian}};
    }
    const TextScanner whole(path, file, {.comment = '\0'});
    const auto in_one_go = [&] {
        TextReader reader(whole, faults);
        reader.read();
        return reader.collector().finish();
    };
    return {is_small ? in_one_go()
                     : read_in_slices_if_faultless([&] { return read_text_slices(whole, slicing); }, in_one_go),
            {FileFormat::Stl, Encoding::Ascii}};
}

}  // namespace seamflow
