#include "partition/io/off.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "partition/io/mesh_builder.h"
#include "partition/io/off_binary.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

class OffReader {
  public:
    OffReader(const std::filesystem::path& path, std::string_view text)
        : size_(static_cast<std::int64_t>(text.size()))
        , scanner_(path, text)
        , builder_(scanner_)
    {
    }

    PolygonMesh read();

  private:
    void read_keyword();
    void require_known_variant(std::string_view prefix);
    void read_counts();
    std::int64_t read_count(const char* what, std::int64_t shortest_line);
    void next_line(const char* what, std::int64_t i, std::int64_t n);
    void read_vertex();
    void read_face();

    std::int64_t size_;
    TextScanner scanner_;
    MeshBuilder builder_;
    std::int64_t n_vertices_ = 0;
    std::int64_t n_faces_ = 0;
    std::vector<Index> corners_;
};

PolygonMesh OffReader::read()
{
    read_keyword();
    read_counts();
    builder_.reserve(static_cast<std::uint64_t>(n_vertices_), static_cast<std::uint64_t>(n_faces_));
    for (std::int64_t v = 0; v < n_vertices_; ++v) {
        next_line("vertices", v, n_vertices_);
        read_vertex();
    }
    for (std::int64_t f = 0; f < n_faces_; ++f) {
        next_line("faces", f, n_faces_);
        read_face();
    }
    if (scanner_.next_line())
        scanner_.fail("the file goes on after the " + std::to_string(n_vertices_) + " vertices and " +
                      std::to_string(n_faces_) + " faces that its header announces; correct the counts in the header");
    return builder_.finish();
}

void OffReader::read_keyword()
{
    if (!scanner_.next_line())
        scanner_.fail("the file holds no mesh, only comments or blanks; export the mesh again");
    const auto word = scanner_.peek();
    if (std::all_of(word.begin(), word.end(), is_digit))
        return;
    const auto off = word.find("OFF");
    if (off == std::string_view::npos || (word.size() > off + 3 && !is_digit(word[off + 3])))
        scanner_.fail("the file begins with " + in_quotes(word) +
                      " and not with OFF; if it has another format, give it that format's extension");
    require_known_variant(word.substr(0, off));
    scanner_.skip(off + 3);
    if (scanner_.peek() == "BINARY")
        scanner_.fail(
            "binary OFF files with more than coordinates and faces cannot be read; convert the mesh to text OFF "
            "or to PLY");
}

void OffReader::require_known_variant(std::string_view prefix)
{
    if (prefix.find_first_of("4n") != std::string_view::npos)
        scanner_.fail(
            in_quotes(std::string(prefix) + "OFF") +
            " files, whose vertices have not just three coordinates, cannot be read; convert the mesh to OFF");
    constexpr std::array<std::string_view, 8> known = {"", "C", "N", "CN", "ST", "STC", "STN", "STCN"};
    if (std::find(known.begin(), known.end(), prefix) == known.end())
        scanner_.fail("the keyword " + in_quotes(std::string(prefix) + "OFF") +
                      " is unknown; convert the mesh to OFF, COFF or NOFF");
}

void OffReader::read_counts()
{
    if (!scanner_.has_token() && !scanner_.next_line())
        scanner_.fail("the file ends before the numbers of vertices and faces; export the mesh again");
    n_vertices_ = read_count("the number of vertices", 6);
    n_faces_ = read_count("the number of faces", 4);
    if (scanner_.has_token())
        scanner_.integer("the number of edges");
    if (scanner_.has_token())
        scanner_.fail("expected the end of the line after the numbers of vertices, faces and edges, but found " +
                      in_quotes(scanner_.peek()) + "; correct the header");
}

/// @param shortest_line the fewest characters in which a vertex or a face can be written, with the line end.
std::int64_t OffReader::read_count(const char* what, std::int64_t shortest_line)
{
    const std::int64_t n = scanner_.integer(what);
    if (n < 0 || n > (size_ + 1) / shortest_line)
        scanner_.fail(std::string(what) + " is " + std::to_string(n) + ", but a file of " + std::to_string(size_) +
                      " bytes cannot hold so many; correct the header, or export the mesh again if it was cut off");
    return n;
}

void OffReader::next_line(const char* what, std::int64_t i, std::int64_t n)
{
    if (!scanner_.next_line())
        scanner_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " " + what +
                      "; it has been cut off, or the counts in its header are wrong: export the mesh again");
}

void OffReader::read_vertex()
{
    const double x = scanner_.real("coordinate x");
    const double y = scanner_.real("coordinate y");
    const double z = scanner_.real("coordinate z");
    builder_.add_vertex(x, y, z);
}

void OffReader::read_face()
{
    const std::int64_t n = scanner_.integer("the number of corners of a face");
    corners_.clear();
    for (std::int64_t k = 0; k < n; ++k)
        corners_.push_back(builder_.vertex(scanner_.integer("the vertices of all corners of the face"), n_vertices_));
    builder_.add_face(corners_);
}

/// Where the data begin if the first line is `OFF BINARY`, else nothing.
std::optional<std::size_t> start_of_binary_data(std::string_view text)
{
    const std::string_view line = text.substr(0, text.find('\n'));
    const auto second = line.find_first_not_of(" \t", 3);
    if (!line.starts_with("OFF") || second == 3 || second == std::string_view::npos ||
        !line.substr(second).starts_with("BINARY") || line.size() == text.size())
        return std::nullopt;
    return line.size() + 1;
}

}  // namespace

PolygonMesh read_off(const std::filesystem::path& path, std::string_view text)
{
    if (const auto data = start_of_binary_data(text))
        return read_binary_off(path, text, *data);
    return OffReader(path, text).read();
}

void write_off(OutputFile& file, const PolygonMesh& mesh)
{
    file.text("OFF\n");
    file.number(mesh.n_vertices());
    file.text(" ");
    file.number(mesh.n_faces());
    file.text(" 0\n");
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        for (Index k = 0; k < 3; ++k) {
            file.number(mesh.vertices(v, k));
            file.text(k < 2 ? " " : "\n");
        }
    }
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        file.number(mesh.face(f).size());
        for (const Index v : mesh.face(f)) {
            file.text(" ");
            file.number(v);
        }
        file.text("\n");
    }
}

}  // namespace seamflow
