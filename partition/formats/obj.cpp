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
#include "partition/formats/obj_scan.h"
#include "partition/io/mesh_builder.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// Reads a slice of a file. Statements other than vertices and faces are skipped.
class ObjReader {
  public:
    /// @param n_vertices the number of vertices of the whole file.
    ObjReader(const TextScanner& scanner, Index n_vertices, const MeshSlice& slice, FaultLog* faults)
        : scanner_(scanner)
        , n_vertices_(n_vertices)
        , builder_(scanner_, 1, slice)
    {
        scanner_.note_faults_in(faults);
    }

    /// Reads all lines of the slice.
    void read(const ObjCounts& before)
    {
        scan_obj(scanner_, *this, before);
        require_vertices(scanner_, n_vertices_);
    }

    /// scan_obj calls these functions for vertices and faces.
    void plain_vertex(Index /*v*/, const WrittenNumbers& p)
    {
        builder_.add_vertex({p.values[0], p.values[1], p.values[2]});
    }
    void plain_face(std::span<const Index> vertices) { builder_.add_face(vertices); }
    void position(Index /*v*/, TextScanner& scanner) { builder_.add_vertex(scanner.coordinates()); }
    void colour(Index v, TextScanner& scanner, std::size_t n_behind);
    void face(TextScanner& scanner, const ObjCounts& before);

  private:
    Index read_corner(std::int64_t n_vertices);
    void require_attributes(std::string_view attributes);

    TextScanner scanner_;
    Index n_vertices_;
    MeshBuilder builder_;
    std::vector<Index> corners_;
    /// The highest number of a missing vertex that a face has named so far.
    std::int64_t highest_missing_ = 0;
};

/// scan_vertex calls this for the numbers after the coordinates, which are not needed here. More than a weight, red,
/// green, blue and alpha mean that a line has several vertices.
void ObjReader::colour(Index /*v*/, TextScanner& scanner, std::size_t /*n_behind*/)
{
    constexpr std::size_t most_further_numbers = 5;
    if (scanner.pass_over_rest() > most_further_numbers)
        scanner.fail("a vertex has 3 coordinates, optionally with a weight and a colour, but this line continues; put "
                     "each vertex on a line of its own");
}

void ObjReader::face(TextScanner& scanner, const ObjCounts& before)
{
    corners_.clear();
    while (scanner.has_token())
        corners_.push_back(read_corner(before.n_vertices));
    builder_.add_face(corners_);
}

/// Reads a corner of a face.
/// @param n_vertices the number of vertices before the line. @returns its vertex; -1 if there is no such vertex.
Index ObjReader::read_corner(std::int64_t n_vertices)
{
    const auto [number, attributes] = read_obj_corner(scanner_, "a vertex number (as in 7, 7/1, 7//2 or 7/1/2)");
    require_attributes(attributes);
    if (number < -n_vertices) {
        scanner_.fault(counted_back_too_far(number, n_vertices, "correct the face or export the mesh again"));
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
        return static_cast<Index>(number + n_vertices);
    // A missing vertex is reported only if its number is the highest so far.
    if (number > n_vertices_) {
        if (number > std::exchange(highest_missing_, std::max(highest_missing_, number)))
            scanner_.fault(fmt::format("names vertex {}, but the file has only {}; correct the face or export the mesh "
                                       "again",
                                       number, counted(usize(n_vertices_), "vertex", "vertices")));
        return -1;
    }
    return static_cast<Index>(number - 1);
}

/// Checks the numbers of a texture coordinate and a normal: /t, //n, /t/n, and the empty / and //.
void ObjReader::require_attributes(std::string_view attributes)
{
    int slashes = 0;
    for (const char c : attributes) {
        slashes += c == '/' ? 1 : 0;
        if (slashes > 2 || (c != '/' && c != '-' && c != '+' && (c < '0' || c > '9')))
            scanner_.fail("expected a corner as in 7, 7/1, 7//2 or 7/1/2, but found {} after the vertex number; "
                          "correct the face or export the mesh again",
                          in_quotes(attributes));
    }
}

/// Reads the mesh from the slices of a file.
/// @param faults if not null, collects faults instead of throwing; null if there are several slices.
/// @throws InputError for a fault that `faults` does not collect; the message names the line if there is one slice.
PolygonMesh read_slices(const TextScanner& whole, std::span<const std::string_view> slices, const Executor& exec,
                        FaultLog* faults)
{
    const std::vector<ObjCounts> counts = count_obj(whole, slices, exec);
    const auto n_vertices = static_cast<Index>(counts.back().n_vertices);
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(n_vertices);
    append_faces(mesh, static_cast<Index>(slices.size()), exec, [&](Index i, PolygonMesh& faces) {
        const auto first = static_cast<Index>(counts[i].n_vertices);
        ObjReader(TextScanner(whole, slices[i]), n_vertices, {mesh.vertices, first, faces}, faults).read(counts[i]);
    });
    return mesh;
}

/// A visitor for scan_obj that collects the content of a file besides the surface.
struct ExtrasVisitor {
    std::vector<std::string> extras = {};

    void colour(Index /*v*/, TextScanner& scanner, std::size_t /*n_behind*/)
    {
        if (const std::size_t n = scanner.pass_over_rest(); n > 0)
            add_once(extras, n > 2 ? "colours" : "weights");
    }
    void normal(Index /*n*/, TextScanner& /*scanner*/) { add_once(extras, "normals"); }
    void line(TextScanner& /*scanner*/, const ObjCounts& /*before*/) { add_once(extras, "lines"); }
    void other(std::string_view keyword)
    {
        using Entry = std::pair<std::string_view, std::string_view>;
        constexpr std::array<Entry, 8> known = {Entry{"vt", "texture coordinates"},
                                                Entry{"mtllib", "materials"},
                                                Entry{"usemtl", "materials"},
                                                Entry{"g", "groups"},
                                                Entry{"o", "groups"},
                                                Entry{"s", "smoothing groups"},
                                                Entry{"p", "points"},
                                                Entry{"vp", "curves"}};
        const auto* const found = std::ranges::find(known, keyword, &Entry::first);
        add_once(extras, found != known.end() ? found->second : "other statements");
    }
};

}  // namespace

ObjCorner read_obj_corner(TextScanner& scanner, const char* what)
{
    const std::int64_t vertex = scanner.integer_before_slash(what);
    const std::string_view attributes = scanner.rest_of_token();
    scanner.skip(attributes.size());
    return {vertex, attributes};
}

std::string counted_back_too_far(std::int64_t vertex, std::int64_t n, const char* remedy)
{
    return fmt::format("names vertex {}, counted back from this line, but only {} it; {}", vertex,
                       counted(static_cast<std::uint64_t>(n), "vertex precedes", "vertices precede"), remedy);
}

std::vector<ObjCounts> count_obj(const TextScanner& whole, std::span<const std::string_view> slices,
                                 const Executor& exec)
{
    std::vector<ObjCounts> counts(slices.size() + 1);
    for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
        ObjCounter counter;
        counts[i + 1] = scan_obj(TextScanner(whole, slices[i]), counter);
    });
    for (std::size_t i = 0; i < slices.size(); ++i) {
        counts[i + 1].n_vertices += counts[i].n_vertices;
        counts[i + 1].n_normals += counts[i].n_normals;
    }
    constexpr std::int64_t most = std::numeric_limits<Index>::max();
    if (std::max(counts.back().n_vertices, counts.back().n_normals) > most)
        whole.fail("more than {} vertices or normals; divide the mesh into several files", most);
    return counts;
}

PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text, const Slicing& slicing, FaultLog* faults)
{
    const TextScanner whole(path, text, obj_syntax);
    const std::vector<std::string_view> slices = whole.slices(slicing.bytes);
    const auto in_one_go = [&] { return read_slices(whole, std::array{whole.rest()}, run_serially, faults); };
    if (slices.size() < 2)
        return in_one_go();
    return read_in_slices_if_faultless([&] { return read_slices(whole, slices, slicing.exec, nullptr); }, in_one_go);
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
    std::vector<ExtrasVisitor> visitors(slices.size());
    for_each(slicing.exec, static_cast<Index>(slices.size()),
             [&](Index i) { scan_obj(TextScanner(whole, slices[i]), visitors[i]); });
    std::vector<std::string> extras;
    for (const ExtrasVisitor& visitor : visitors)
        for (const std::string& extra : visitor.extras)
            add_once(extras, extra);
    return extras;
}

}  // namespace seamflow
