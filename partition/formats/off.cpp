#include "partition/formats/off.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/splicing.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

/// The beginning of a text OFF file.
struct OffHeader {
    /// What stands before OFF: ST, C, N together mean texture coordinates, colours and normals of the vertices.
    std::string_view prefix;
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;

    [[nodiscard]] bool has_normals() const { return prefix.ends_with('N'); }
};

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

void require_known_variant(const TextScanner& scanner, std::string_view prefix)
{
    if (prefix.find_first_of("4n") != std::string_view::npos)
        scanner.fail(in_quotes(std::string(prefix) + "OFF") +
                     " files, whose vertices have not just three coordinates, cannot be read; convert the mesh to OFF");
    constexpr std::array<std::string_view, 8> known = {"", "C", "N", "CN", "ST", "STC", "STN", "STCN"};
    if (std::find(known.begin(), known.end(), prefix) == known.end())
        scanner.fail("the keyword " + in_quotes(std::string(prefix) + "OFF") +
                     " is unknown; convert the mesh to OFF, COFF or NOFF");
}

/// @returns what stands before OFF.
std::string_view read_keyword(TextScanner& scanner)
{
    if (!scanner.next_line())
        scanner.fail("the file holds no mesh, only comments or blanks; export the mesh again");
    const auto word = scanner.peek();
    if (std::all_of(word.begin(), word.end(), is_digit))
        return {};
    const auto off = word.find("OFF");
    if (off == std::string_view::npos || (word.size() > off + 3 && !is_digit(word[off + 3])))
        scanner.fail("the file begins with " + in_quotes(word) +
                     " and not with OFF; if it has another format, give it that format's extension");
    const std::string_view prefix = word.substr(0, off);
    require_known_variant(scanner, prefix);
    scanner.skip(off + 3);
    if (scanner.peek() == "BINARY")
        scanner.fail(
            "binary OFF files with more than coordinates and faces cannot be read; convert the mesh to text OFF "
            "or to PLY");
    return prefix;
}

/// @param size of the file, in bytes. @param shortest_line the fewest characters in which a vertex or a face can be
/// written, with the line end.
std::int64_t read_count(TextScanner& scanner, std::int64_t size, const char* what, std::int64_t shortest_line)
{
    const std::int64_t n = scanner.integer(what);
    if (n < 0 || n > (size + 1) / shortest_line)
        scanner.fail(fmt::format("{} is {}, but a file of {} bytes cannot hold so many; correct the header, or export "
                                 "the mesh again if it was cut off",
                                 what, n, size));
    return n;
}

/// Reads from the beginning of the file to the end of the counts.
/// @throws InputError naming the line; also for vertices that have not three coordinates, and for counts that the file
///         is too short for.
OffHeader read_off_header(TextScanner& scanner)
{
    const auto size = static_cast<std::int64_t>(scanner.rest().size());
    OffHeader header;
    header.prefix = read_keyword(scanner);
    if (!scanner.has_token() && !scanner.next_line())
        scanner.fail("the file ends before the numbers of vertices and faces; export the mesh again");
    header.n_vertices = read_count(scanner, size, "the number of vertices", 6);
    header.n_faces = read_count(scanner, size, "the number of faces", 4);
    if (scanner.has_token())
        scanner.integer("the number of edges");
    if (scanner.has_token())
        scanner.fail("expected the end of the line after the numbers of vertices, faces and edges, but found " +
                     in_quotes(scanner.peek()) + "; correct the header");
    return header;
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

    OffReader(const TextScanner& scanner, const OffHeader& header, const MeshSlice& slice)
        : scanner_(scanner)
        , builder_(scanner_, 0, slice)
        , header_(header)
    {
    }

    /// Reads vertices and faces, which are counted together.
    void read(std::int64_t begin, std::int64_t end);

    PolygonMesh finish();

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
    }
    for (std::int64_t f = std::max(begin, n_vertices) - n_vertices; f < end - n_vertices; ++f) {
        next_line("faces", f, header_.n_faces);
        read_face();
    }
}

PolygonMesh OffReader::finish()
{
    if (scanner_.next_line())
        scanner_.fail(fmt::format("the file goes on after the {} vertices and {} faces that its header announces; "
                                  "correct the counts in the header",
                                  header_.n_vertices, header_.n_faces));
    return builder_.finish();
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

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_slices(const TextScanner& after_header, const OffHeader& header, const Slicing& slicing)
{
    const std::vector<std::string_view> slices = after_header.slices(slicing.bytes);
    const std::vector<std::int64_t> first = count_lines(after_header, slices, slicing.loop);
    if (header.n_vertices == 0 || first.back() != header.n_vertices + header.n_faces)
        throw InputError("the file ends too early, or goes on");
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(sum_of_counts(0, header.n_vertices));
    mesh.face_offsets.reserve(static_cast<std::size_t>(header.n_faces) + 1);
    append_faces(mesh, static_cast<Index>(slices.size()), slicing.loop, [&](Index i, PolygonMesh& faces) {
        const auto first_vertex = static_cast<Index>(std::min(first[i], header.n_vertices));
        OffReader reader(TextScanner(after_header, slices[i]), header, {mesh.vertices, first_vertex, faces});
        reader.read(first[i], first[i + 1]);
    });
    return mesh;
}

/// Writes the lines of a slice that are vertices.
/// @param v the first of them. @param normals null: there are none.
void rewrite_slice(Splicer splicer, TextScanner scanner, Index v, Index end, const PolygonMesh& mesh,
                   const MovedNormals* normals)
{
    for (; v < end; ++v) {
        scanner.next_line();
        exchange_position(scanner, splicer, mesh.vertices.row(v));
        if (normals == nullptr)
            continue;
        const WrittenNormal given = read_normal(scanner);
        if (const auto now = normals->around_vertex(v, given.value))
            exchange_normal(splicer, given, *now);
    }
    splicer.finish();
}

/// The kinds of the numbers after the coordinates, by the keyword of the file.
void add_extras_of_keyword(std::vector<std::string>& extras, const OffHeader& header)
{
    const std::string_view prefix = header.prefix;
    if (prefix.find("ST") != std::string_view::npos)
        add_once(extras, "texture coordinates");
    if (prefix.find('C') != std::string_view::npos)
        add_once(extras, "colours");
    if (header.has_normals())
        add_once(extras, "normals");
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

PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, const Slicing& slicing, FaultLog* faults)
{
    if (const auto data = start_of_binary_off(text))
        return read_binary_off(path, text, *data, slicing, faults);
    TextScanner scanner(path, text);
    const OffHeader header = read_off_header(scanner);
    const auto in_one_go = [&] {
        OffReader reader(scanner, header, faults);
        reader.read(0, header.n_vertices + header.n_faces);
        return reader.finish();
    };
    if (text.size() <= slicing.bytes)
        return in_one_go();
    return read_in_slices_if_faultless([&] { return read_slices(scanner, header, slicing); }, in_one_go);
}

void write_off(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing)
{
    file.text("OFF\n");
    file.line("", std::array{mesh.n_vertices(), mesh.n_faces(), 0});
    constexpr std::size_t line_bytes = 32;
    const Index per_slice = elements_per_slice(slicing, line_bytes);
    write_elements(file, mesh.n_vertices(), per_slice, slicing.loop,
                   [&](ByteWriter& slice, Index v) { slice.line("", mesh.vertices.row(v)); });
    write_elements(file, mesh.n_faces(), per_slice, slicing.loop, [&](ByteWriter& slice, Index f) {
        slice.number(mesh.face(f).size());
        slice.text(" ");
        slice.line("", mesh.face(f));
    });
}

std::vector<std::string> rewrite_off(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing)
{
    if (const auto data = start_of_binary_off(content)) {
        if (rewrite_binary_off(file, content, *data, mesh, slicing))
            return {rounding_remark(path)};
        return {};
    }
    TextScanner scanner(path, content);
    std::optional<MovedNormals> normals;
    FaultLog known_faults{.of_faces_alone = true};
    if (read_off_header(scanner).has_normals())
        normals.emplace(mesh, read_off(path, content, slicing, &known_faults).vertices, slicing.loop);
    const std::vector<std::string_view> slices = scanner.slices(slicing.bytes);
    const std::vector<std::int64_t> first = count_lines(scanner, slices, slicing.loop);
    const auto vertices_before = [&](Index i) {
        return static_cast<Index>(std::min<std::int64_t>(first[i], mesh.n_vertices()));
    };
    file.text(content.substr(0, content.size() - scanner.rest().size()));
    file.slices(static_cast<Index>(slices.size()), slicing.loop, [&](Index i, OutputBuffer& slice) {
        rewrite_slice(Splicer(slice, slices[i]), TextScanner(scanner, slices[i]), vertices_before(i),
                      vertices_before(i + 1), mesh, normals ? &*normals : nullptr);
    });
    return {};
}

std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content)
{
    std::vector<std::string> extras;
    if (start_of_binary_off(content))
        return extras;
    TextScanner scanner(path, content);
    const OffHeader header = read_off_header(scanner);
    add_extras_of_keyword(extras, header);
    for (std::int64_t v = 0; v < header.n_vertices && scanner.next_line(); ++v)
        if (scanner.pass_over_rest() > 3 && header.prefix.empty())
            add_once(extras, "further numbers of vertices");
    for (std::int64_t f = 0; f < header.n_faces && scanner.next_line(); ++f)
        if (const std::int64_t n = scanner.integer("corners"); scanner.pass_over_rest() > static_cast<std::size_t>(n))
            add_once(extras, "colours of faces");
    return extras;
}

}  // namespace seamflow
