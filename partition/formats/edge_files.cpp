#include "partition/formats/edge_files.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/obj_scan.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_source.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

/// Collects edges, and refuses pairs that cannot be edges of the mesh.
class EdgeList {
  public:
    explicit EdgeList(Index n_vertices)
        : n_vertices_(n_vertices)
    {
    }

    /// @param v, w counted from 0. @param position of the edge, for messages. @param first the file's first index.
    void add(std::int64_t v, std::int64_t w, const InputPosition& position, int first)
    {
        for (const std::int64_t end : {v, w})
            if (end < 0 || end >= n_vertices_)
                position.fail(fmt::format("there is no vertex {}: the mesh has {}, numbered from {}; use the file with "
                                          "the mesh it belongs to",
                                          end + first, n_vertices_, first));
        if (v == w)
            position.fail(fmt::format("names vertex {} twice; an edge has two ends", v + first));
        edges_.push_back({static_cast<Index>(v), static_cast<Index>(w)});
    }

    [[nodiscard]] std::vector<Edge> take() { return std::move(edges_); }

  private:
    Index n_vertices_;
    std::vector<Edge> edges_;
};

/// Reads the polylines of an OBJ file; see scan_obj.
struct LineReader {
    EdgeList& list;

    void line(TextScanner& scanner, const ObjCounts& before)
    {
        const std::int64_t n_vertices = before.n_vertices;
        std::int64_t previous = -1;
        for (int n = 0; scanner.has_token(); ++n) {
            const std::int64_t number = read_obj_corner(scanner, "a vertex number (as in 7 or 7/1)").vertex;
            if (number < -n_vertices)
                scanner.fail(counted_back_too_far(number, n_vertices, "correct the line"));
            const std::int64_t v = number < 0 ? n_vertices + number : number - 1;
            if (n > 0)
                list.add(previous, v, scanner, 1);
            previous = v;
        }
    }
};

void read_edges_of_ply(TextScanner scanner, const std::filesystem::path& path, std::string_view content, EdgeList& list)
{
    const PlyHeader header = read_ply_header(scanner);
    const PlyElement* const element = header.element("edge");
    if (element == nullptr)
        return;
    for (const char* name : {"vertex1", "vertex2"}) {
        const auto found = std::ranges::find(element->properties, name, &PlyProperty::name);
        if (found == element->properties.end() || found->length_type || !is_integer(found->type))
            throw InputError(fmt::format("{}: the edges have no integer property {}; declare vertex1 and vertex2",
                                         scanner.position_of(element->line), name));
    }
    const PlyData data{path, content, header, scanner, scanner.rest(), PlyUse::OtherData};
    std::int64_t ends[2] = {-1, -1};
    data.scan(
        data.whole(), *element,
        columns_of(*element,
                   [](const PlyProperty& p) { return p.name == "vertex1"   ? 0
                                                     : p.name == "vertex2" ? 1
                                                                           : -1; }),
        [&](PlySource& source, Index, Index column, const PlyProperty& property) {
            ends[column] = source.integer(property.type);
        },
        [&](PlySource& source, Index) { list.add(ends[0], ends[1], source.position(), 0); });
}

void read_pairs(TextScanner scanner, EdgeList& list)
{
    while (scanner.next_line()) {
        const char* const what = "two vertex numbers on each line";
        const std::int64_t v = scanner.integer(what);
        const std::int64_t w = scanner.integer(what);
        if (scanner.has_token())
            scanner.fail("the line continues after two vertex numbers; write one edge per line");
        list.add(v, w, scanner, 0);
    }
}

}  // namespace

std::vector<Edge> read_edges(const std::filesystem::path& path, Index n_vertices)
{
    const std::optional<FileFormat> format = format_of(path);
    if (format && format != FileFormat::Obj && format != FileFormat::Ply)
        throw InputError(path.string() + ": the format has no edges of its own; use OBJ (lines l), PLY (element edge), "
                                         "or a text file with two vertex numbers per line");
    const InputFile file{OpenFile(path)};
    EdgeList list(n_vertices);
    if (format == FileFormat::Obj) {
        LineReader reader{list};
        scan_obj(TextScanner(path, file.content(), obj_syntax), reader);
    } else if (format == FileFormat::Ply)
        read_edges_of_ply(TextScanner(path, file.content(), ply_syntax), path, file.content(), list);
    else
        read_pairs(TextScanner(path, file.content()), list);
    std::vector<Edge> edges = list.take();
    if (edges.empty() && format)
        throw InputError(path.string() + ": the file has no edges of its own: " +
                         (format == FileFormat::Obj ? "lines l" : "elements edge") + " would name them");
    return edges;
}

}  // namespace seamflow
