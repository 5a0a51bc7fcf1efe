#include "partition/formats/edge_files.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

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

/// Reads edges, and refuses pairs that cannot be edges of the mesh.
class EdgeReader {
  public:
    explicit EdgeReader(Index n_vertices)
        : n_vertices_(n_vertices)
    {
    }

    /// Reads a polyline of an OBJ file: scan_obj calls this.
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
                add(previous, v, scanner, 1);
            previous = v;
        }
    }

    /// Reads the elements of a PLY file.
    void read_elements(const std::filesystem::path& path, std::string_view content)
    {
        const PlyData data = ply_data_of(path, content, PlyUse::OtherData);
        const PlyElement* const element = data.header.element("edge");
        if (element == nullptr)
            return;
        for (const char* name : {"vertex1", "vertex2"})
            if (const PlyProperty* const found = element->property(name);
                found == nullptr || found->length_type || !is_integer(found->type))
                data.after_header.fail_at(element->line,
                                          "the edges have no integer property {}; declare vertex1 and vertex2", name);
        std::int64_t ends[2] = {-1, -1};
        data.scan(
            data.whole(), *element, columns_of(*element, {"vertex1", "vertex2"}),
            [&](PlySource& source, Index, Index column, const PlyProperty& property) {
                ends[column] = source.integer(property.type);
            },
            [&](PlySource& source, Index) { add(ends[0], ends[1], source.position(), 0); });
    }

    /// Reads two numbers on each line.
    void read_pairs(TextScanner scanner)
    {
        while (scanner.next_line()) {
            const char* const what = "two vertex numbers on each line";
            const std::int64_t v = scanner.integer(what);
            const std::int64_t w = scanner.integer(what);
            if (scanner.has_token())
                scanner.fail("the line continues after two vertex numbers; write one edge per line");
            add(v, w, scanner, 0);
        }
    }

    [[nodiscard]] std::vector<Edge> take() { return std::move(edges_); }

  private:
    /// @param v, w counted from 0. @param position of the edge, for messages. @param first the file's first index.
    void add(std::int64_t v, std::int64_t w, const InputPosition& position, int first)
    {
        for (const std::int64_t end : {v, w})
            if (end < 0 || end >= n_vertices_)
                position.fail("there is no vertex {}: the mesh has {}, numbered from {}; use the file with the mesh it "
                              "belongs to",
                              end + first, n_vertices_, first);
        if (v == w)
            position.fail("names vertex {} twice; an edge has two ends", v + first);
        edges_.push_back({static_cast<Index>(v), static_cast<Index>(w)});
    }

    Index n_vertices_;
    std::vector<Edge> edges_;
};

}  // namespace

std::vector<Edge> read_edges(const DataFile& file, Index n_vertices)
{
    EdgeReader reader(n_vertices);
    const std::filesystem::path& path = file.path();
    const std::optional<FileFormat> format = file.format();
    if (format && format != FileFormat::Obj && format != FileFormat::Ply)
        throw InputError(path.string() + ": the format has no edges of its own; use OBJ (lines l), PLY (element edge), "
                                         "or a text file with two vertex numbers per line");
    const InputFile input{OpenFile(path)};
    if (!format)
        reader.read_pairs({path, input.content()});
    else if (format == FileFormat::Ply)
        reader.read_elements(path, input.content());
    else
        scan_obj(TextScanner(path, input.content(), obj_syntax), reader);
    std::vector<Edge> edges = reader.take();
    if (edges.empty() && format)
        throw InputError(path.string() + ": the file has no edges of its own: " +
                         (format == FileFormat::Obj ? "lines l" : "elements edge") + " would name them");
    return edges;
}

}  // namespace seamflow
