#include "partition/formats/obj.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/text_slices.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

namespace {

/// A vertex that a face named before the file defined it.
struct ForwardReference {
    std::int64_t vertex;
    std::size_t line;
};

/// Reads a whole file, or a slice of one.
class ObjReader {
  public:
    ObjReader(const TextScanner& scanner, FaultLog* faults)
        : scanner_(scanner)
        , builder_(scanner_, 1)
    {
        scanner_.note_faults_in(faults);
    }

    ObjReader(const TextScanner& scanner, const MeshSlice& slice, FaultLog* faults = nullptr)
        : scanner_(scanner)
        , builder_(scanner_, 1, slice)
    {
        scanner_.note_faults_in(faults);
    }

    /// Reads all lines.
    void read()
    {
        while (true) {
            if (read_plain_vertex() || read_plain_face())
                continue;
            if (!scanner_.next_line())
                break;
            // Texture coordinates, normals, groups, materials, points, lines, … are ignored here.
            if (const std::string_view keyword = scanner_.token(); keyword.size() == 1 && keyword[0] == 'v')
                read_vertex();
            else if (is_obj_face(keyword))
                read_face();
        }
    }

    /// @param n number of vertices in the whole file.
    /// @throws InputError if a face names one that it does not have.
    void require_no_open_reference(Index n) const;

    PolygonMesh finish()
    {
        require_no_open_reference(builder_.n_vertices());
        return builder_.finish();
    }

  private:
    bool read_plain_vertex();
    bool read_plain_face();
    void read_vertex();
    void read_face();
    Index read_corner();
    void pass_over_attributes();

    TextScanner scanner_;
    MeshBuilder builder_;
    std::vector<Index> corners_;
    /// Ascending in both vertex and line, so that the first unresolved one is the first in the file.
    std::vector<ForwardReference> forward_references_;
};

/// The functions read_plain_… read a line in its commonest form, without fault, and return false if it has another.
bool ObjReader::read_plain_vertex()
{
    std::array<double, 3> position{};
    const bool is_plain = scanner_.next_plain_line([&](PlainLine& line) {
        return line.keyword('v') && line.real(position[0]) && line.real(position[1]) && line.real(position[2]) &&
               line.ends();
    });
    if (is_plain)
        builder_.add_vertex(position);
    return is_plain;
}

bool ObjReader::read_plain_face()
{
    corners_.clear();
    const auto n = static_cast<std::uint64_t>(builder_.n_vertices());
    const bool is_plain = scanner_.next_plain_line([&](PlainLine& line) {
        if (!line.keyword('f'))
            return false;
        while (!line.ends()) {
            std::uint64_t number = 0;
            if (!line.corner(number) || number == 0 || number > n)
                return false;
            corners_.push_back(static_cast<Index>(number - 1));
        }
        return true;
    });
    if (is_plain)
        builder_.add_face(corners_);
    return is_plain;
}

void ObjReader::read_vertex()
{
    const auto position = scanner_.coordinates();
    constexpr std::size_t most_further_numbers = 5;
    if (scanner_.pass_over_rest() > most_further_numbers)
        scanner_.fail("a vertex has 3 coordinates, optionally with a weight and a colour, but this line continues; put "
                      "each vertex on a line of its own");
    builder_.add_vertex(position);
}

void ObjReader::read_face()
{
    corners_.clear();
    while (scanner_.has_token())
        corners_.push_back(read_corner());
    builder_.add_face(corners_);
}

Index ObjReader::read_corner()
{
    const std::int64_t number = scanner_.integer_before_slash("a vertex number (as in 7, 7/1, 7//2 or 7/1/2)");
    pass_over_attributes();
    const std::int64_t n = builder_.n_vertices();
    if (number < -n) {
        scanner_.fault(fmt::format("names vertex {}, counted back from this line, but only {} it; correct the face or "
                                   "export the mesh again",
                                   number,
                                   counted(static_cast<std::uint64_t>(n), "vertex precedes", "vertices precede")));
        return -1;
    }
    if (number == 0) {
        scanner_.fault("names vertex 0, but the vertices of an OBJ file are numbered from 1; add 1 to all of them or "
                       "export the mesh again");
        return -1;
    }
    constexpr Index largest = std::numeric_limits<Index>::max();
    if (number > largest) {
        scanner_.fault(
            fmt::format("names vertex {}, but a mesh has {} vertices at most; correct the face or export the "
                        "mesh again",
                        number, largest));
        return -1;
    }
    if (number < 0)
        return static_cast<Index>(number + n);
    if (number > n && (forward_references_.empty() || number - 1 > forward_references_.back().vertex))
        forward_references_.push_back({number - 1, scanner_.line()});
    return static_cast<Index>(number - 1);
}

/// The numbers of a texture coordinate and a normal: /t, //n, /t/n, and the empty / and //.
void ObjReader::pass_over_attributes()
{
    const std::string_view rest = scanner_.rest_of_token();
    int slashes = 0;
    for (const char c : rest) {
        slashes += c == '/' ? 1 : 0;
        if (slashes > 2 || (c != '/' && c != '-' && c != '+' && (c < '0' || c > '9')))
            scanner_.fail("expected a corner as in 7, 7/1, 7//2 or 7/1/2, but found " + in_quotes(rest) +
                          " after the vertex number; correct the face or export the mesh again");
    }
    scanner_.skip(rest.size());
}

void ObjReader::require_no_open_reference(Index n) const
{
    for (const auto& [vertex, line] : forward_references_)
        if (vertex >= n)
            scanner_.fault_at(scanner_.position_of(line),
                              fmt::format("names vertex {}, but the file has only {}; correct the face or export the "
                                          "mesh again",
                                          vertex + 1, counted(at(n), "vertex", "vertices")));
}

/// @throws InputError if there is any fault, not necessarily naming the line.
PolygonMesh read_slices(const TextScanner& whole, const TextSlices& slices, const Executor& exec)
{
    if (slices.all.n_vertices == 0)
        throw InputError("no vertices");
    const auto first = static_cast<Index>(slices.counts.front().n_vertices);
    const auto n_vertices = static_cast<Index>(slices.all.n_vertices);
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(static_cast<Index>(slices.counts.back().n_vertices) - first);
    append_faces(mesh, static_cast<Index>(slices.bytes.size()), exec, [&](Index i, PolygonMesh& faces) {
        const auto first_of_slice = static_cast<Index>(slices.counts[i].n_vertices);
        ObjReader reader(TextScanner(whole, slices.bytes[i]), {mesh.vertices, first_of_slice, faces, first});
        reader.read();
        reader.require_no_open_reference(n_vertices);
    });
    return mesh;
}

std::string_view extra_of_statement(std::string_view keyword)
{
    using Entry = std::pair<std::string_view, std::string_view>;
    constexpr std::array<Entry, 10> known = {Entry{"vt", "texture coordinates"},
                                             Entry{"vn", "normals"},
                                             Entry{"mtllib", "materials"},
                                             Entry{"usemtl", "materials"},
                                             Entry{"g", "groups"},
                                             Entry{"o", "groups"},
                                             Entry{"s", "smoothing groups"},
                                             Entry{"p", "points"},
                                             Entry{"l", "lines"},
                                             Entry{"vp", "curves"}};
    for (const auto& [name, extra] : known)
        if (keyword == name)
            return extra;
    return "other statements";
}

std::vector<std::string> extras_of_slice(TextScanner scanner)
{
    std::vector<std::string> extras;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        if (is_obj_face(keyword))
            continue;
        if (keyword != "v") {
            add_once(extras, extra_of_statement(keyword));
            continue;
        }
        const std::size_t n = scanner.pass_over_rest();
        if (n > 3)
            add_once(extras, n > 5 ? "colours" : "weights");
    }
    return extras;
}

}  // namespace

std::vector<TextCounts> count_obj(const TextScanner& whole, std::span<const std::string_view> slices,
                                  const Executor& exec)
{
    std::vector<TextCounts> counts(slices.size() + 1);
    for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
        TextScanner scanner(whole, slices[i]);
        std::string_view keyword;
        while (!(keyword = scanner.next_keyword()).empty()) {
            counts[i + 1].n_vertices += keyword == "v" ? 1 : 0;
            counts[i + 1].n_normals += keyword == "vn" ? 1 : 0;
        }
    });
    for (std::size_t i = 0; i < slices.size(); ++i) {
        counts[i + 1].n_vertices = sum_of_counts(counts[i].n_vertices, counts[i + 1].n_vertices);
        counts[i + 1].n_normals = sum_of_counts(counts[i].n_normals, counts[i + 1].n_normals);
    }
    return counts;
}

PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text, const Slicing& slicing, FaultLog* faults)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const auto in_one_go = [&] {
        ObjReader reader(whole, faults);
        reader.read();
        return reader.finish();
    };
    if (slices.size() < 2)
        return in_one_go();
    const auto in_slices = [&] {
        const std::vector<TextCounts> counts = count_obj(whole, slices, slicing.exec);
        return read_slices(whole, {slices, counts, counts.back()}, slicing.exec);
    };
    return read_in_slices_if_faultless(in_slices, in_one_go);
}

void write_obj(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing)
{
    constexpr std::size_t line_bytes = 32;
    const Index per_slice = elements_per_slice(slicing, line_bytes);
    write_elements(file, mesh.n_vertices(), per_slice, slicing.exec,
                   [&](ByteWriter& slice, Index v) { slice.line("v", mesh.vertices.row(v)); });
    write_elements(file, mesh.n_faces(), per_slice, slicing.exec, [&](ByteWriter& slice, Index f) {
        slice.text("f");
        for (const Index v : mesh.face(f)) {
            slice.text(" ");
            slice.number(std::int64_t{v} + 1);
        }
        slice.text("\n");
    });
}

std::vector<std::string> extras_of_obj(const std::filesystem::path& path, std::string_view text, const Slicing& slicing)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    std::vector<std::vector<std::string>> of_slice(slices.size());
    for_each(slicing.exec, static_cast<Index>(slices.size()),
             [&](Index i) { of_slice[i] = extras_of_slice(TextScanner(whole, slices[i])); });
    std::vector<std::string> extras;
    for (const auto& list : of_slice)
        for (const std::string& extra : list)
            add_once(extras, extra);
    return extras;
}

}  // namespace seamflow
