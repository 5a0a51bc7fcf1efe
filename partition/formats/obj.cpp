#include "partition/formats/obj.h"

#include <cstdint>
#include <string>
#include <vector>

#include "partition/errors.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

namespace {

/// What a line of the file is about.
enum class Statement {
    Vertex,
    Face,
    /// Texture coordinates, normals, groups, materials, points, lines, … and whatever else this reader has no use for.
    Other
};

Statement statement_of(std::string_view keyword)
{
    if (keyword == "v")
        return Statement::Vertex;
    if (is_obj_face(keyword))
        return Statement::Face;
    return Statement::Other;
}

/// A vertex that a face named before the file defined it.
struct ForwardReference {
    Index vertex;
    std::size_t line;
};

class ObjReader {
  public:
    ObjReader(const std::filesystem::path& path, std::string_view text, FaultLog* faults)
        : scanner_(path, text, obj_syntax)
        , builder_(scanner_, 1)
    {
        scanner_.note_faults_in(faults);
    }

    PolygonMesh read()
    {
        while (scanner_.next_line()) {
            switch (statement_of(scanner_.token())) {
            case Statement::Vertex:
                read_vertex();
                break;
            case Statement::Face:
                read_face();
                break;
            case Statement::Other:
                break;
            }
        }
        require_no_open_reference();
        return builder_.finish();
    }

  private:
    void read_vertex();
    void read_face();
    Index read_corner();
    void pass_over_attributes();
    void require_no_open_reference() const;

    TextScanner scanner_;
    MeshBuilder builder_;
    std::vector<Index> corners_;
    /// Ascending in both vertex and line, so that the first one left open is the first in the file.
    std::vector<ForwardReference> forward_references_;
};

void ObjReader::read_vertex()
{
    const double x = scanner_.real("coordinate x");
    const double y = scanner_.real("coordinate y");
    const double z = scanner_.real("coordinate z");
    constexpr int most_further_numbers = 5;
    int further_numbers = 0;
    while (!scanner_.token().empty())
        ++further_numbers;
    if (further_numbers > most_further_numbers)
        scanner_.fail("a vertex has 3 coordinates, perhaps a weight and a colour after them, but this line goes on; "
                      "put each vertex on a line of its own");
    builder_.add_vertex(x, y, z);
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
        scanner_.fault("names vertex " + std::to_string(number) + ", counted back from this line, but only " +
                       counted(static_cast<std::uint64_t>(n), "vertex precedes", "vertices precede") +
                       " it; correct the face or export the mesh again");
        return -1;
    }
    if (number == 0) {
        scanner_.fault("names vertex 0, but the vertices of an OBJ file are numbered from 1; add 1 to all of them or "
                       "export the mesh again");
        return -1;
    }
    if (number < 0)
        return static_cast<Index>(number + n);
    const Index vertex = builder_.vertex(number - 1, std::int64_t{1} << 31);
    if (vertex >= n && (forward_references_.empty() || vertex > forward_references_.back().vertex))
        forward_references_.push_back({vertex, scanner_.line()});
    return vertex;
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

void ObjReader::require_no_open_reference() const
{
    const Index n = builder_.n_vertices();
    for (const auto& [vertex, line] : forward_references_)
        if (vertex >= n)
            scanner_.fault_at(scanner_.position_of(line),
                              "names vertex " + std::to_string(std::int64_t{vertex} + 1) + ", but the file has only " +
                                  counted(static_cast<std::uint64_t>(n), "vertex", "vertices") +
                                  "; correct the face or export the mesh again");
}

}  // namespace

PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text, FaultLog* faults)
{
    return ObjReader(path, text, faults).read();
}

void write_obj(OutputFile& file, const PolygonMesh& mesh)
{
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        file.text("v");
        for (Index k = 0; k < 3; ++k) {
            file.text(" ");
            file.number(mesh.vertices(v, k));
        }
        file.text("\n");
    }
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        file.text("f");
        for (const Index v : mesh.face(f)) {
            file.text(" ");
            file.number(std::int64_t{v} + 1);
        }
        file.text("\n");
    }
}

}  // namespace seamflow
