#include "tests/support/mesh_files.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <system_error>

#include "tests/support/temporary_directory.h"

namespace seamflow::test {

namespace {

std::string without_folder(std::string message, const TemporaryDirectory& folder)
{
    const std::string prefix = folder.path().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
    return message;
}

}  // namespace

MeshFile read_text(const std::string& name, std::string_view content)
{
    const TemporaryDirectory folder;
    return read_mesh(folder.with(name, content));
}

std::string complaint_about(const std::string& name, std::string_view content)
{
    const TemporaryDirectory folder;
    return without_folder(message_of<InputError>([&] { read_mesh(folder.with(name, content)); }), folder);
}

std::string complaint_of_writing(const PolygonMesh& mesh, const std::string& name, const FileKind& kind)
{
    const TemporaryDirectory folder;
    const std::string message = message_of<OutputError>([&] { write_mesh(folder.path() / name, mesh, kind); });
    const bool leaves_file = !message.empty() && folder.n_files() > 0;
    return without_folder(message, folder) + (leaves_file ? " [and a file is left behind]" : "");
}

MeshFile round_trip(const PolygonMesh& mesh, const std::string& name, const FileKind& kind)
{
    const TemporaryDirectory folder;
    write_mesh(folder.path() / name, mesh, kind);
    return read_mesh(folder.path() / name);
}

Rewritten rewritten(const std::string& name, std::string_view content, const std::function<void(Points&)>& change)
{
    const TemporaryDirectory folder;
    MeshFile file = read_mesh(folder.with(name, content));
    change(file.mesh.vertices);
    const auto copy = folder / ("copy of " + name);
    Rewritten result;
    result.remarks = write_mesh_like(*file.source, copy, file.mesh);
    for (std::string& remark : result.remarks)
        remark = without_folder(remark, folder);
    result.content = content_of(copy);
    return result;
}

bool identical(const PolygonMesh& a, const PolygonMesh& b)
{
    const auto n_bytes = static_cast<std::size_t>(a.vertices.size()) * sizeof(double);
    return a.vertices.rows() == b.vertices.rows() && a.face_offsets == b.face_offsets &&
           a.face_vertices == b.face_vertices && std::memcmp(a.vertices.data(), b.vertices.data(), n_bytes) == 0;
}

Points tricky_points(bool single_precision)
{
    using Double = std::numeric_limits<double>;
    using Float = std::numeric_limits<float>;
    Points points(6, 3);
    if (single_precision)
        points << 0.0, -0.0, 1.0, double{0.1F}, double{-0.1F}, double{Float::denorm_min()}, double{Float::max()},
            double{Float::min()}, -double{Float::max()}, 16777216.0, 16777215.0, -1e10F, double{1.0F / 3.0F}, 3.0, 7.0,
            -double{Float::denorm_min()}, -0.0, -0.0;
    else
        points << 0.0, -0.0, 1.0, 0.1, -0.1, Double::denorm_min(), Double::max(), Double::min(), 1e308,
            9007199254740993.0, 123456789012345680000.0, -1e17, 1.0 / 3.0, 0.30000000000000004, 2.2250738585072011e-308,
            -Double::denorm_min(), -0.0, 5e-324;
    return points;
}

PolygonMesh make_mesh(const Points& vertices, std::initializer_list<std::initializer_list<Index>> faces)
{
    PolygonMesh mesh;
    mesh.vertices = vertices;
    for (const auto& face : faces)
        mesh.add_face({face.begin(), face.size()});
    return mesh;
}

PolygonMesh make_triangle()
{
    Points vertices(3, 3);
    vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    return make_mesh(vertices, {{0, 1, 2}});
}

}  // namespace seamflow::test
