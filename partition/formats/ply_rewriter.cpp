#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "partition/formats/ply.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_ranges.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/formats/splicing.h"

namespace seamflow {

namespace {

/// The numbers of a vertex that are rewritten.
constexpr std::array<std::string_view, 6> columns = {"x", "y", "z", "nx", "ny", "nz"};
using Row = Eigen::Matrix<double, 1, columns.size()>;

using Change = PlyChange;

/// Whether that type can represent the numbers, floats after rounding.
bool can_hold(PlyType type, const auto& numbers)
{
    return with_type(type, [&numbers](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return std::all_of(numbers.begin(), numbers.end(), [](double number) {
            const bool in_range =
                number >= static_cast<double>(Limits::lowest()) && number <= static_cast<double>(Limits::max());
            return in_range && (!Limits::is_integer || std::trunc(number) == number);
        });
    });
}

/// The kind of the vertex properties nx, ny and nz.
enum class Normals {
    None,
    /// Floating-point numbers.
    Usable,
    /// Not all three, or integers, whose scale is unknown, or lists.
    Other
};

Normals normals_of(const PlyElement& vertices)
{
    Index n_found = 0;
    Index n_usable = 0;
    for (const PlyProperty& property : vertices.properties) {
        if (std::find(columns.begin() + 3, columns.end(), property.name) == columns.end())
            continue;
        ++n_found;
        n_usable += !property.length_type && !is_integer(property.type) ? 1 : 0;
    }
    return n_usable == 3 ? Normals::Usable : n_found > 0 ? Normals::Other : Normals::None;
}

std::vector<Change> changes_of(const PlyElement& vertices, const std::array<bool, 3>& fits, bool with_normals)
{
    const auto n_columns = with_normals ? columns.end() : columns.begin() + 3;
    std::vector<Change> changes;
    for (const PlyProperty& property : vertices.properties) {
        const auto column = std::find(columns.begin(), n_columns, property.name);
        Change change;
        if (column != n_columns) {
            change = {static_cast<Index>(column - columns.begin()), property.type};
            if (change.column < 3 && !fits[change.column])
                change.type = PlyType::Float64;
        }
        changes.push_back(change);
    }
    return changes;
}

/// Writes the vertices of a slice of a file.
template <class Source>
class VertexRewriter {
  public:
    VertexRewriter(Source& source, Splicer& splicer, Encoding encoding)
        : source_(source)
        , splicer_(splicer)
        , encoding_(encoding)
    {
    }

    /// Writes vertex v.
    /// @param normals null: there are none.
    void rewrite(const PlyElement& vertices, const std::vector<Change>& changes, Index v, const Point& position,
                 const MovedNormals* normals);

    [[nodiscard]] bool rounded() const { return rounded_; }

  private:
    Row read(const PlyElement& vertices, const std::vector<Change>& changes, Index v);
    void exchange(std::string_view part, const Change& change, double number);

    Source& source_;
    Splicer& splicer_;
    Encoding encoding_;
    /// For one vertex, one entry per property: its bytes if it may change.
    std::vector<std::string_view> parts_;
    bool rounded_ = false;
};

template <class Source>
Row VertexRewriter<Source>::read(const PlyElement& vertices, const std::vector<Change>& changes, Index v)
{
    Row row = Row::Zero();
    parts_.assign(changes.size(), {});
    source_.begin_element(vertices, at(v));
    for (std::size_t p = 0; p < changes.size(); ++p) {
        const PlyProperty& property = vertices.properties[p];
        if (changes[p].column < 0) {
            pass_over(source_, property);
            continue;
        }
        parts_[p] = source_.peek(property.type);
        row[changes[p].column] = source_.number(property.type);
    }
    source_.end_element();
    return row;
}

template <class Source>
void VertexRewriter<Source>::rewrite(const PlyElement& vertices, const std::vector<Change>& changes, Index v,
                                     const Point& position, const MovedNormals* normals)
{
    const Row before = read(vertices, changes, v);
    Row after = before;
    after.head<3>() = position;
    if (normals != nullptr)
        if (const auto now = normals->around_vertex(v, before.tail<3>()))
            after.tail<3>() = *now;
    for (std::size_t p = 0; p < changes.size(); ++p) {
        const Index column = changes[p].column;
        const bool wider = encoding_ != Encoding::Ascii && changes[p].type != vertices.properties[p].type;
        if (column >= 0 && (wider || differ(before[column], after[column])))
            exchange(parts_[p], changes[p], after[column]);
    }
}

template <class Source>
void VertexRewriter<Source>::exchange(std::string_view part, const Change& change, double number)
{
    ByteWriter& file = splicer_.exchange(part);
    const bool is_position = change.column < 3;
    if (encoding_ != Encoding::Ascii) {
        with_type(change.type,
                  [&](auto zero) { file.binary(static_cast<decltype(zero)>(number), order_of(encoding_)); });
        const bool single = change.type == PlyType::Float32;
        rounded_ = rounded_ || (is_position && single && double{static_cast<float>(number)} != number);
    } else if (is_position || change.type == PlyType::Float64) {
        file.number(number);
    } else {
        file.number(static_cast<float>(number));
    }
}

/// Declares wider types where that is necessary.
std::vector<std::string> rewrite_header(Splicer& splicer, const std::filesystem::path& path, const PlyElement& vertices,
                                        const std::vector<Change>& changes)
{
    std::vector<std::string> remarks;
    for (std::size_t p = 0; p < changes.size(); ++p) {
        const PlyProperty& property = vertices.properties[p];
        if (changes[p].column < 0 || changes[p].type == property.type)
            continue;
        splicer.exchange(property.type_word).text("double");
        remarks.push_back("the type of " + property.name + " is double instead of " + std::string(property.type_word) +
                          ": the type in " + path.string() + " cannot hold the result");
    }
    return remarks;
}

/// Writes a slice.
/// @returns whether positions were rounded.
template <class Source>
bool rewrite_slice(Source source, Splicer splicer, const PlyHeader& header, const PlySlice& slice,
                   const std::vector<Change>& changes, const NewVertices<MovedNormals>& now)
{
    VertexRewriter<Source> rewriter(source, splicer, header.encoding);
    const PlyElement* const vertices = header.element("vertex");
    const auto n_elements = static_cast<std::size_t>(vertices - header.elements.data()) + 1;
    for_each_kind(std::span(header.elements).first(n_elements), slice,
                  [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
                      for (std::uint64_t i = begin; i < end; ++i)
                          if (&element != vertices)
                              pass_over(source, element, i);
                          else
                              rewriter.rewrite(element, changes, static_cast<Index>(i),
                                               now.position(static_cast<std::int64_t>(i)), now.normals);
                  });
    splicer.finish();
    return rewriter.rounded();
}

/// A file as it was read.
struct ReadPly {
    const std::filesystem::path& path;
    std::string_view content;
    const PlyHeader& header;
    /// At the last line of the header.
    const TextScanner& after_header;
};

/// Writes all that follows the header.
/// @returns whether positions were rounded.
bool rewrite_elements(OutputFile& file, const ReadPly& read, const std::vector<Change>& changes,
                      const NewVertices<MovedNormals>& now, const Slicing& slicing)
{
    const PlyHeader& header = read.header;
    const PlyElement* const vertices = header.element("vertex");
    const std::span<const PlyElement> elements(header.elements.data(), vertices + 1);
    std::vector<PlySlice> slices = slice_ply(read.content, read.after_header, header.encoding, elements, slicing);
    const bool crosses_lines = header.encoding == Encoding::Ascii && slices.back().end != header.n_elements();
    if (crosses_lines)
        slices = {{0, header.n_elements(), read.after_header.rest()}};
    std::vector<std::uint8_t> rounded(slices.size());
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        // Those that the reader has accepted.
        FaultLog known_faults{.of_faces_alone = true};
        const auto rewrite = [&](auto source) {
            source.note_faults_in(&known_faults);
            return rewrite_slice(std::move(source), Splicer(slice, slices[i].bytes), header, slices[i], changes, now);
        };
        const auto offset = static_cast<std::size_t>(slices[i].bytes.data() - read.content.data());
        TextScanner scanner(read.after_header, slices[i].bytes);
        if (crosses_lines)
            scanner.cross_lines();
        rounded[i] = header.encoding == Encoding::Ascii
                         ? rewrite(PlyTextSource(scanner))
                         : rewrite(PlyBinarySource(read.path, read.content, offset, header.encoding));
    });
    const std::string_view last = slices.back().bytes;
    file.text(read.content.substr(static_cast<std::size_t>(last.data() - read.content.data()) + last.size()));
    return std::ranges::find(rounded, 1) != rounded.end();
}

}  // namespace

std::array<bool, 3> coordinates_fit(const PlyElement& vertices, const Points& positions)
{
    std::array<bool, 3> fits = {true, true, true};
    if (positions.rows() == 0)
        return fits;
    for (const PlyProperty& property : vertices.properties)
        if (const auto column = std::find(columns.begin(), columns.begin() + 3, property.name);
            column != columns.begin() + 3)
            fits[column - columns.begin()] = can_hold(property.type, positions.col(column - columns.begin()));
    return fits;
}

std::vector<PlyChange> changes_of_positions(const PlyElement& vertices, const std::array<bool, 3>& fits)
{
    return changes_of(vertices, fits, false);
}

std::vector<std::string> rewrite_ply_header(ByteWriter& file, const std::filesystem::path& path,
                                            std::string_view header, const PlyElement& vertices,
                                            const std::vector<PlyChange>& changes)
{
    Splicer splicer(file, header);
    std::vector<std::string> remarks = rewrite_header(splicer, path, vertices, changes);
    splicer.finish();
    if (normals_of(vertices) != Normals::None)
        remarks.push_back(kept_normals_remark(path, "normals"));
    return remarks;
}

bool rewrite_ply_vertices(ByteWriter& file, const PlyRanges& ply, Index begin, const Points& positions,
                          const std::vector<PlyChange>& changes)
{
    const std::string_view bytes = ply.bytes_of_vertices(begin, begin + static_cast<Index>(positions.rows()));
    const auto offset = static_cast<std::size_t>(bytes.data() - ply.content().data());
    PlyBinarySource source(ply.path(), ply.content(), offset, ply.header().encoding);
    Splicer splicer(file, bytes);
    VertexRewriter<PlyBinarySource> rewriter(source, splicer, ply.header().encoding);
    for (Index v = 0; v < positions.rows(); ++v)
        rewriter.rewrite(ply.vertex_element(), changes, v, positions.row(v), nullptr);
    splicer.finish();
    return rewriter.rounded();
}

void rewrite_ply_text(ByteWriter& file, const TextScanner& after_header, const PlyHeader& header, const PlySlice& slice,
                      const Points& positions, Index first)
{
    FaultLog known_faults{.of_faces_alone = true};
    PlyTextSource source(TextScanner(after_header, slice.bytes));
    source.note_faults_in(&known_faults);
    const std::vector<Change> changes = changes_of_positions(*header.element("vertex"), {true, true, true});
    rewrite_slice(std::move(source), Splicer(file, slice.bytes), header, slice, changes, {positions, first});
}

std::vector<std::string> rewrite_ply(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing)
{
    TextScanner scanner(path, content, ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    const ReadPly read{path, content, header, scanner};
    const PlyElement& vertices = *header.element("vertex");
    const std::vector<Change> changes =
        changes_of(vertices, coordinates_fit(vertices, mesh.vertices), normals_of(vertices) == Normals::Usable);
    std::optional<MovedNormals> normals;
    FaultLog known_faults{.of_faces_alone = true};
    if (normals_of(vertices) == Normals::Usable)
        normals.emplace(mesh, read_ply(path, content, slicing, &known_faults).mesh.vertices, slicing.exec);
    Splicer splicer(file, content.substr(0, content.size() - scanner.rest().size()));
    std::vector<std::string> remarks = rewrite_header(splicer, path, vertices, changes);
    splicer.finish();
    const bool rounded =
        rewrite_elements(file, read, changes, {mesh.vertices, 0, normals ? &*normals : nullptr}, slicing);
    if (normals_of(vertices) == Normals::Other)
        remarks.push_back("the normals of " + path.string() +
                          " are written as they were: they are not three floating-point numbers nx, ny, nz");
    if (rounded)
        remarks.push_back(rounding_remark(path));
    return remarks;
}

}  // namespace seamflow
