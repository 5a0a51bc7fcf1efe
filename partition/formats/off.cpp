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
#include "partition/formats/text_slices.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

void pass_over_numbers(TextScanner& scanner, Index n)
{
    for (; n > 0; --n)
        static_cast<void>(scanner.number_or_nan());
}

/// Reads a whole file, or a slice of one.
class OffReader {
  public:
    OffReader(const TextScanner& after_header, const OffHeader& header, FaultLog* faults)
        : scanner_(after_header)
        , builder_(scanner_)
        , header_(header)
    {
        scanner_.note_faults_in(faults);
        builder_.reserve(static_cast<std::uint64_t>(header.n_vertices), static_cast<std::uint64_t>(header.n_faces));
    }

    OffReader(const TextScanner& scanner, const OffHeader& header, const MeshSlice& slice, FaultLog* faults = nullptr)
        : scanner_(scanner)
        , builder_(scanner_, 0, slice)
        , header_(header)
    {
        scanner_.note_faults_in(faults);
    }

    /// Reads vertices and faces, which are counted together.
    void read(std::int64_t begin, std::int64_t end);

    /// Checks that no line is left.
    void require_end();

    PolygonMesh finish()
    {
        require_end();
        return builder_.finish();
    }

  private:
    void next_line(const char* what, std::int64_t i, std::int64_t n);
    void read_face();

    TextScanner scanner_;
    MeshBuilder builder_;
    OffHeader header_;
    std::vector<Index> corners_;
};

void OffReader::read(std::int64_t begin, std::int64_t end)
{
    const std::int64_t n_vertices = header_.n_vertices;
    for (std::int64_t v = begin; v < std::min(end, n_vertices); ++v) {
        next_line("vertices", v, n_vertices);
        builder_.add_vertex(scanner_.coordinates());
        if (scanner_.crosses_lines())
            pass_over_numbers(scanner_, header_.n_further_numbers());
    }
    for (std::int64_t f = std::max(begin, n_vertices) - n_vertices; f < end - n_vertices; ++f) {
        next_line("faces", f, header_.n_faces);
        read_face();
    }
}

void OffReader::require_end()
{
    if (scanner_.next_line())
        scanner_.fail(fmt::format("the file continues after the {} vertices and {} faces that its header announces; "
                                  "correct the counts in the header",
                                  header_.n_vertices, header_.n_faces));
}

void OffReader::next_line(const char* what, std::int64_t i, std::int64_t n)
{
    if (!scanner_.next_line())
        scanner_.fail(fmt::format("the file ends after {} of {} {}; it has been cut off, or the counts in its header "
                                  "are wrong: export the mesh again",
                                  i, n, what));
}

void OffReader::read_face()
{
    const std::int64_t n = scanner_.integer("the number of corners of a face");
    corners_.clear();
    for (std::int64_t k = 0; k < n; ++k)
        corners_.push_back(
            builder_.vertex(scanner_.integer("the vertices of all corners of the face"), header_.n_vertices));
    builder_.add_face(corners_);
}

std::vector<TextCounts> count_slices(const TextScanner& after_header, std::span<const std::string_view> slices,
                                     const Executor& exec)
{
    std::vector<TextCounts> counts;
    for (const std::int64_t n : count_lines(after_header, slices, exec))
        counts.push_back({.n_lines = n});
    return counts;
}

Index vertices_before(const TextCounts& counts, const OffHeader& header)
{
    return static_cast<Index>(std::min(counts.n_lines, header.n_vertices));
}

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_slices(const TextScanner& after_header, const OffHeader& header, const TextSlices& slices,
                        const Executor& exec)
{
    if (header.n_vertices == 0 || slices.all.n_lines != header.n_lines())
        throw InputError("the file ends too early, or goes on");
    static_cast<void>(sum_of_counts(0, header.n_vertices));
    const TextCounts& begin = slices.counts.front();
    const TextCounts& end = slices.counts.back();
    const Index first = vertices_before(begin, header);
    const Index n_vertices = vertices_before(end, header) - first;
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(n_vertices);
    mesh.face_offsets.reserve(static_cast<std::size_t>(end.n_lines - begin.n_lines - n_vertices) + 1);
    append_faces(mesh, static_cast<Index>(slices.bytes.size()), exec, [&](Index i, PolygonMesh& faces) {
        OffReader reader(TextScanner(after_header, slices.bytes[i]), header,
                         {mesh.vertices, vertices_before(slices.counts[i], header), faces, first});
        reader.read(slices.counts[i].n_lines, slices.counts[i + 1].n_lines);
    });
    return mesh;
}

/// Writes the lines of a slice that are vertices.
/// @param v, end the first of them and the one past the last.
void rewrite_slice(Splicer splicer, TextScanner scanner, Index v, Index end, const NewVertices<MovedNormals>& now,
                   const OffHeader& header, const NewColours& colours = {})
{
    for (; v < end; ++v) {
        scanner.next_line();
        exchange_position(scanner, splicer, now.position(v));
        if (header.has_normals()) {
            const WrittenNormal given = read_normal(scanner);
            const auto moved = now.normals != nullptr ? now.normals->around_vertex(v, given.value) : std::nullopt;
            if (moved)
                exchange_normal(splicer, given, *moved);
        }
        colours.exchange(scanner, splicer, v, at(header.n_numbers_behind_colour()));
        if (scanner.crosses_lines())
            pass_over_numbers(scanner, header.n_numbers_behind_colour());
    }
    splicer.finish();
}

/// The kinds of the numbers after the coordinates, by the keyword of the file.
void add_extras_of_keyword(std::vector<std::string>& extras, const OffHeader& header)
{
    if (header.has_texture())
        add_once(extras, "texture coordinates");
    if (header.has_colours())
        add_once(extras, "colours");
    if (header.has_normals())
        add_once(extras, "normals");
}

PolygonMesh read_by_lines(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults)
{
    TextScanner scanner(path, text);
    const OffHeader header = read_off_header(scanner);
    const auto in_one_go = [&] {
        OffReader reader(scanner, header, faults);
        reader.read(0, header.n_lines());
        return reader.finish();
    };
    if (text.size() <= slicing.bytes)
        return in_one_go();
    const auto in_slices = [&] {
        const std::vector<std::string_view> slices = scanner.slices(slicing.bytes);
        const std::vector<TextCounts> counts = count_slices(scanner, slices, slicing.exec);
        return read_slices(scanner, header, {slices, counts, counts.back()}, slicing.exec);
    };
    return read_in_slices_if_faultless(in_slices, in_one_go);
}

/// The header, read to its end, of a file in which line breaks can be blanks; nothing if there is none. This is
/// unambiguous only if all vertices have equally many numbers, and faces nothing but corners.
std::optional<OffHeader> read_header_across_lines(TextScanner& scanner)
{
    scanner.cross_lines();
    try {
        const OffHeader header = read_off_header(scanner);
        return header.has_colours() ? std::nullopt : std::optional(header);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// Whether a file lacks one line per vertex and face, or its header only makes sense with line breaks as blanks. A file
/// with these lines is only ever read line by line, so that it is written line by line, too.
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

/// Reads a file with line breaks as blanks; nothing if that fails.
std::optional<PolygonMesh> read_across_lines(const std::filesystem::path& path, std::string_view text,
                                             const Slicing& slicing)
{
    if (!breaks_lines_freely(path, text, slicing))
        return std::nullopt;
    TextScanner scanner(path, text);
    const auto header = read_header_across_lines(scanner);
    if (!header)
        return std::nullopt;
    try {
        OffReader reader(scanner, *header, nullptr);
        reader.read(0, header->n_lines());
        return reader.finish();
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, const Slicing& slicing, FaultLog* faults)
{
    if (const auto data = start_of_binary_off(text))
        return read_binary_off(path, text, *data, slicing, faults);
    FaultLog own = faults != nullptr ? *faults : FaultLog();
    try {
        PolygonMesh mesh = read_by_lines(path, text, slicing, faults != nullptr ? &own : nullptr);
        if (faults == nullptr || own.count == faults->count)
            return mesh;
        // What has faults line by line may have none across lines.
        if (std::optional<PolygonMesh> across = read_across_lines(path, text, slicing))
            return *std::move(across);
        *faults = std::move(own);
        return mesh;
    } catch (const InputError&) {
        if (std::optional<PolygonMesh> mesh = read_across_lines(path, text, slicing))
            return *std::move(mesh);
        if (faults != nullptr)
            *faults = std::move(own);
        throw;
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
    FaultLog known_faults{.of_faces_alone = true};
    if (header.has_normals())
        normals.emplace(mesh, read_off(path, content, slicing, &known_faults).vertices, slicing.exec, seam_distance);
    const NewVertices<MovedNormals> now{mesh.vertices, 0, normals ? &*normals : nullptr};
    if (crosses_lines) {
        rewrite_slice(Splicer(file, content), scanner, 0, mesh.n_vertices(), now, header);
        return colours.remarks();
    }
    const std::vector<std::string_view> slices = scanner.slices(slicing.bytes);
    const std::vector<TextCounts> counts = count_slices(scanner, slices, slicing.exec);
    file.text(content.substr(0, content.size() - scanner.rest().size()));
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        rewrite_slice(Splicer(slice, slices[i]), TextScanner(scanner, slices[i]), vertices_before(counts[i], header),
                      vertices_before(counts[i + 1], header), now, header, colours);
    });
    return colours.remarks();
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
    add_extras_of_keyword(extras, header);
    if (crosses_lines)
        return extras;
    for (std::int64_t v = 0; v < header.n_vertices && scanner.next_line(); ++v)
        if (scanner.pass_over_rest() > 3 && header.prefix.empty())
            add_once(extras, "further numbers of vertices");
    for (std::int64_t f = 0; f < header.n_faces && scanner.next_line(); ++f)
        if (const std::int64_t n = scanner.integer("corners"); scanner.pass_over_rest() > static_cast<std::size_t>(n))
            add_once(extras, "colours of faces");
    return extras;
}

}  // namespace seamflow
