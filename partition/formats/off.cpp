#include "partition/formats/off.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/off_header.h"
#include "partition/formats/splicing.h"
#include "partition/formats/text_colours.h"
#include "partition/formats/text_vertices.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// Goes to the next line. @param what the content of such lines. @param i, n the number of the present line, and of
/// all.
/// @throws InputError if there is no further line.
void next_line(TextScanner& scanner, const char* what, std::int64_t i, std::int64_t n)
{
    if (!scanner.next_line())
        scanner.fail("the file ends after {} of {} {}; it has been cut off, or the counts in its header "
                     "are wrong: export the mesh again",
                     i, n, what);
}

/// Scans lines of text OFF after its header, which are vertices, then faces. Besides the functions of scan_vertex the
/// visitor may have
/// - face(scanner): reads a face, beginning at its number of corners.
/// @param begin, end the lines, counted from 0.
/// @throws InputError if the file ends too early.
template <class Visitor>
void scan_off(TextScanner& scanner, const OffHeader& header, std::int64_t begin, std::int64_t end, Visitor& visitor)
{
    const std::int64_t n_vertices = header.n_vertices;
    for (std::int64_t v = begin; v < std::min(end, n_vertices); ++v) {
        next_line(scanner, "vertices", v, n_vertices);
        scan_vertex(scanner, static_cast<Index>(v), header.layout(), visitor);
    }
    if constexpr (requires { visitor.face(scanner); })
        for (std::int64_t f = std::max(begin, n_vertices) - n_vertices; f < end - n_vertices; ++f) {
            next_line(scanner, "faces", f, header.n_faces);
            visitor.face(scanner);
        }
}

/// Reads a slice of a file.
class OffReader {
  public:
    OffReader(const TextScanner& scanner, const OffHeader& header, const MeshSlice& slice, FaultLog* faults)
        : scanner_(scanner)
        , builder_(scanner_, 0, slice)
        , header_(header)
    {
        scanner_.note_faults_in(faults);
    }

    /// Reads the lines begin to end - 1: vertices, then faces, counted together from 0.
    void read(std::int64_t begin, std::int64_t end) { scan_off(scanner_, header_, begin, end, *this); }

    /// Checks that nothing follows.
    void require_end();

    /// scan_off calls this for the coordinates of a vertex.
    void position(Index /*v*/, TextScanner& scanner) { builder_.add_vertex(scanner.coordinates()); }
    /// scan_off calls this for a face.
    void face(TextScanner& scanner);

  private:
    TextScanner scanner_;
    MeshBuilder builder_;
    OffHeader header_;
    std::vector<Index> corners_;
};

void OffReader::require_end()
{
    if (scanner_.next_line())
        scanner_.fail("the file continues after the {} vertices and {} faces that its header announces; "
                      "correct the counts in the header",
                      header_.n_vertices, header_.n_faces);
    require_vertices(scanner_, header_.n_vertices);
}

void OffReader::face(TextScanner& scanner)
{
    const std::int64_t n = scanner.integer("the number of corners of a face");
    corners_.clear();
    for (std::int64_t k = 0; k < n; ++k)
        corners_.push_back(
            builder_.vertex(scanner.integer("the vertices of all corners of the face"), header_.n_vertices));
    builder_.add_face(corners_);
}

/// Reads the mesh from the slices of a file.
/// @param slices after the header.
/// @param lines_before the number of lines with a token before each slice, and in all slices.
/// @param faults if not null, collects faults instead of throwing; null if there are several slices.
/// @throws InputError for a fault that `faults` does not collect; the message names it only if there is one slice,
/// because slices of several do not know the numbers of their lines.
PolygonMesh read_slices(const TextScanner& after_header, const OffHeader& header,
                        std::span<const std::string_view> slices, std::span<const std::int64_t> lines_before,
                        const Executor& exec, FaultLog* faults)
{
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(sum_of_counts(0, header.n_vertices));
    mesh.face_offsets.reserve(static_cast<std::size_t>(header.n_faces) + 1);
    append_faces(mesh, static_cast<Index>(slices.size()), exec, [&](Index i, PolygonMesh& faces) {
        const auto first_vertex = static_cast<Index>(std::min(lines_before[i], header.n_vertices));
        OffReader reader(slices.size() > 1 ? TextScanner(after_header, slices[i]) : after_header, header,
                         {mesh.vertices, first_vertex, faces}, faults);
        reader.read(lines_before[i], lines_before[i + 1]);
        if (slices.size() == 1)
            reader.require_end();
    });
    return mesh;
}

/// Reads the mesh as one slice.
/// @param faults if not null, collects faults instead of throwing.
PolygonMesh read_in_one_go(const TextScanner& after_header, const OffHeader& header, FaultLog* faults)
{
    return read_slices(after_header, header, std::array{after_header.rest()},
                       std::array{std::int64_t{0}, header.n_lines()}, run_serially, faults);
}

/// Reads the colours of the vertices of a text OFF file whose keyword has a C.
/// @param n_components 4: all colours must have alpha; 3: alpha may be missing.
/// @returns #V by 4: red, green, blue and alpha, 0 where alpha is missing.
/// @throws InputError for other files, and naming the line of a vertex without a colour.
TextColours read_off_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing)
{
    if (start_of_binary_off(text))
        throw InputError(path.string() + ": no colours of vertices can be read from binary OFF files; convert the mesh "
                                         "to text OFF or to PLY");
    TextScanner scanner(path, text);
    const OffHeader header = read_off_header(scanner);
    if (!header.has_colours())
        scanner.fail(
            "the keyword {} announces no colours of vertices; write them behind the coordinates, and the keyword COFF",
            in_quotes(std::string(header.prefix) + "OFF"));
    return read_text_colours(scanner, slicing, [&](const std::vector<std::string_view>& slices, const Executor& exec) {
        const std::vector<std::int64_t> lines_before = count_lines(scanner, slices, exec);
        TextColours colours(static_cast<Index>(header.n_vertices), 4);
        ColourReader reader{colours, n_components};
        for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
            TextScanner lines(scanner, slices[i], scanner.line());
            scan_off(lines, header, lines_before[i], lines_before[i + 1], reader);
        });
        return colours;
    });
}

/// A visitor for scan_off that collects the content of a file besides the surface.
struct OffExtrasVisitor {
    const OffHeader& header;
    std::vector<std::string>& extras;

    void colour(Index /*v*/, TextScanner& scanner, std::size_t /*n_behind*/)
    {
        if (scanner.has_token() && header.prefix.empty())
            add_once(extras, "further numbers of vertices");
    }
    void face(TextScanner& scanner)
    {
        if (const std::int64_t n = scanner.integer("corners"); scanner.pass_over_rest() > static_cast<std::size_t>(n))
            add_once(extras, "colours of faces");
    }
};

/// Reads a file with one line per vertex and face, in slices if it is large and has no fault.
PolygonMesh read_by_lines(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults)
{
    TextScanner scanner(path, text);
    const OffHeader header = read_off_header(scanner);
    const auto in_one_go = [&] { return read_in_one_go(scanner, header, faults); };
    const std::vector<std::string_view> slices = scanner.slices(slicing.bytes);
    if (slices.size() < 2)
        return in_one_go();
    const auto in_slices = [&] {
        const std::vector<std::int64_t> lines_before = count_lines(scanner, slices, slicing.exec);
        if (header.n_vertices == 0 || lines_before.back() != header.n_lines())
            throw InputError("the file ends too early, or goes on");
        return read_slices(scanner, header, slices, lines_before, slicing.exec, nullptr);
    };
    return read_in_slices_if_faultless(in_slices, in_one_go);
}

/// Whether line breaks count as blanks in a file: its number of lines is not that of its vertices and faces, or its
/// header cannot be read line by line. All other files are read only line by line, because rewriting keeps their lines.
bool breaks_lines_freely(const std::filesystem::path& path, std::string_view text, const Slicing& slicing)
{
    TextScanner scanner(path, text);
    try {
        const OffHeader header = read_off_header(scanner);
        const auto slices = scanner.slices(slicing.bytes);
        return count_lines(scanner, slices, slicing.exec).back() != header.n_lines();
    } catch (const InputError&) {
        return true;
    }
}

/// Reads a file in which line breaks count as blanks; nothing if that fails or is ambiguous: all vertices must have
/// equally many numbers, which excludes colours, and faces only corners.
std::optional<PolygonMesh> read_across_lines(const std::filesystem::path& path, std::string_view text,
                                             const Slicing& slicing)
{
    if (!breaks_lines_freely(path, text, slicing))
        return std::nullopt;
    TextScanner scanner(path, text);
    scanner.cross_lines();
    try {
        const OffHeader header = read_off_header(scanner);
        return header.has_colours() ? std::nullopt : std::optional(read_in_one_go(scanner, header, nullptr));
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, const Slicing& slicing, FaultLog* faults)
{
    if (const auto data = start_of_binary_off(text))
        return read_binary_off(path, text, *data, slicing, faults);
    // If the file can only be read across lines, the faults of the first attempt do not count.
    const FaultLog before = faults != nullptr ? *faults : FaultLog();
    try {
        return read_by_lines(path, text, slicing, faults);
    } catch (const InputError&) {
        std::optional<PolygonMesh> across = read_across_lines(path, text, slicing);
        if (!across)
            throw;
        if (faults != nullptr)
            *faults = before;
        return *std::move(across);
    }
}

void write_off(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing)
{
    file.text("OFF\n");
    file.line("", std::array{mesh.n_vertices(), mesh.n_faces(), 0});
    constexpr std::size_t line_bytes = 32;
    const Index per_slice = elements_per_slice(slicing, line_bytes);
    write_elements(file, mesh.n_vertices(), per_slice, slicing.exec,
                   [&](ByteWriter& slice, Index v) { slice.line("", mesh.vertices.row(v)); });
    write_elements(file, mesh.n_faces(), per_slice, slicing.exec, [&](ByteWriter& slice, Index f) {
        slice.number(mesh.face(f).size());
        slice.text(" ");
        slice.line("", mesh.face(f));
    });
}

std::vector<std::string> rewrite_off(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields,
                                     double seam_distance)
{
    const NewColours colours(file.path(), fields, [&](Index n) { return read_off_colours(path, content, n, slicing); });
    if (const auto data = start_of_binary_off(content)) {
        if (rewrite_binary_off(file, content, *data, mesh, slicing))
            return {rounding_remark(path)};
        return {};
    }
    TextScanner scanner(path, content);
    const bool crosses_lines = breaks_lines_freely(path, content, slicing);
    if (crosses_lines)
        scanner.cross_lines();
    const OffHeader header = read_off_header(scanner);
    std::optional<MovedNormals> normals;
    // The file has been read: the faults of faces that were accepted then are not reported again.
    FaultLog known_faults{.of_faces_alone = true};
    if (header.has_normals())
        normals.emplace(mesh, read_off(path, content, slicing, &known_faults).vertices, slicing.exec, seam_distance);
    const auto rewrite = [&](ByteWriter& to, std::string_view bytes, TextScanner from, std::int64_t begin,
                             std::int64_t end) {
        VertexRewriter rewriter{Splicer(to, bytes), mesh.vertices, colours,
                                [&](Index v, const Point& given) { return normals->around_vertex(v, given); }};
        scan_off(from, header, begin, end, rewriter);
        rewriter.splicer.finish();
    };
    if (crosses_lines) {
        rewrite(file, content, scanner, 0, header.n_lines());
        return colours.remarks();
    }
    const std::vector<std::string_view> slices = scanner.slices(slicing.bytes);
    const std::vector<std::int64_t> lines_before = count_lines(scanner, slices, slicing.exec);
    file.text(content.substr(0, content.size() - scanner.rest().size()));
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        rewrite(slice, slices[i], TextScanner(scanner, slices[i]), lines_before[i], lines_before[i + 1]);
    });
    return colours.remarks();
}

FileFields read_off_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing)
{
    return fields_of_colours(path, names, [&](Index n) { return read_off_colours(path, text, n, slicing); });
}

std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content)
{
    std::vector<std::string> extras;
    if (start_of_binary_off(content))
        return extras;
    TextScanner scanner(path, content);
    const bool crosses_lines = breaks_lines_freely(path, content, {});
    if (crosses_lines)
        scanner.cross_lines();
    const OffHeader header = read_off_header(scanner);
    if (header.has_texture())
        add_once(extras, "texture coordinates");
    if (header.has_colours())
        add_once(extras, "colours");
    if (header.has_normals())
        add_once(extras, "normals");
    if (crosses_lines)
        return extras;
    OffExtrasVisitor visitor{header, extras};
    scan_off(scanner, header, 0, header.n_lines(), visitor);
    return extras;
}

}  // namespace seamflow
