#include "partition/formats/off.h"

#include <cstdint>
#include <string>
#include <vector>

#include "partition/formats/off_binary.h"
#include "partition/formats/off_header.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

class OffReader {
  public:
    OffReader(const std::filesystem::path& path, std::string_view text, FaultLog* faults)
        : scanner_(path, text)
        , builder_(scanner_)
    {
        scanner_.note_faults_in(faults);
    }

    PolygonMesh read();

  private:
    void next_line(const char* what, std::int64_t i, std::int64_t n);
    void read_vertex();
    void read_face();

    TextScanner scanner_;
    MeshBuilder builder_;
    OffHeader header_;
    std::vector<Index> corners_;
};

PolygonMesh OffReader::read()
{
    header_ = read_off_header(scanner_);
    builder_.reserve(static_cast<std::uint64_t>(header_.n_vertices), static_cast<std::uint64_t>(header_.n_faces));
    for (std::int64_t v = 0; v < header_.n_vertices; ++v) {
        next_line("vertices", v, header_.n_vertices);
        read_vertex();
    }
    for (std::int64_t f = 0; f < header_.n_faces; ++f) {
        next_line("faces", f, header_.n_faces);
        read_face();
    }
    if (scanner_.next_line())
        scanner_.fail("the file goes on after the " + std::to_string(header_.n_vertices) + " vertices and " +
                      std::to_string(header_.n_faces) +
                      " faces that its header announces; correct the counts in the header");
    return builder_.finish();
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
        corners_.push_back(
            builder_.vertex(scanner_.integer("the vertices of all corners of the face"), header_.n_vertices));
    builder_.add_face(corners_);
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

PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, FaultLog* faults)
{
    if (const auto data = start_of_binary_off(text))
        return read_binary_off(path, text, *data, faults);
    return OffReader(path, text, faults).read();
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
