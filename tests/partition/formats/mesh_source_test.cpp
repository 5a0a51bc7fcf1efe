#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

const std::string before = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nf 1/1 2/1 3/1\n";
const std::string file_after = "v 0 0 0\nv 2 0 0\nv 0 1 0\nvt 0 1\nf 1/1 2/1 3/1\n";

/// A file that has been read, and its second vertex moved.
MeshFile moved_file(const std::filesystem::path& path)
{
    MeshFile file = read_mesh(path);
    file.mesh.vertices(1, 0) = 2.0;
    return file;
}

}  // namespace

TEST_CASE("a file can be written over itself, more than once")
{
    const TemporaryDirectory folder;
    const auto path = folder.with("a.obj", before);
    MeshFile file = moved_file(path);
    write_mesh_like(*file.source, path, file.mesh);
    CHECK(content_of(path) == file_after);
    file.mesh.vertices(1, 0) = 1.0;
    write_mesh_like(*file.source, path, file.mesh);
    CHECK(content_of(path) == before);
    CHECK(folder.n_files() == 1);
}

TEST_CASE("it does not matter that the file was renamed, replaced or removed")
{
    const TemporaryDirectory folder;
    const auto path = folder.with("a.obj", before);
    const MeshFile file = moved_file(path);
    std::filesystem::remove(path);
    static_cast<void>(folder.with("a.obj", "something else"));
    write_mesh_like(*file.source, folder / "b.obj", file.mesh);
    CHECK(content_of(folder / "b.obj") == file_after);
    CHECK(content_of(path) == "something else");
}

TEST_CASE("a file that was changed in place is refused, of the same length or not, and nothing is written")
{
    for (const std::string& changed :
         {before + "# more\n", before.substr(0, 20), std::string(file_after), std::string()}) {
        const TemporaryDirectory folder;
        const auto path = folder.with("a.obj", before);
        const MeshFile file = moved_file(path);
        static_cast<void>(folder.with("a.obj", changed));
        CHECK_THROWS_AS(write_mesh_like(*file.source, folder / "b.obj", file.mesh), InputError);
        CHECK_THROWS_AS(extras_of(*file.source), InputError);
        CHECK_THROWS_AS(write_mesh_like(*file.source, path, file.mesh), InputError);
        CHECK(content_of(path) == changed);
        CHECK(folder.n_files() == 1);
    }
}

TEST_CASE("a mesh with other vertices or faces does not fit")
{
    const TemporaryDirectory folder;
    const MeshFile file = read_mesh(folder.with("a.obj", before));
    const auto refuse = [&](const PolygonMesh& mesh) {
        CHECK_THROWS_AS(write_mesh_like(*file.source, folder / "b.obj", mesh), OutputError);
    };
    PolygonMesh mesh = file.mesh;
    mesh.vertices.conservativeResize(4, 3);
    mesh.vertices.row(3).setZero();
    refuse(mesh);
    mesh = file.mesh;
    mesh.add_face(std::vector<Index>{0, 2, 1});
    refuse(mesh);
    mesh = file.mesh;
    std::swap(mesh.face_vertices[0], mesh.face_vertices[1]);
    refuse(mesh);
    CHECK(folder.n_files() == 1);
}

TEST_CASE("the source of a file outlives its mesh and is shared by copies")
{
    const TemporaryDirectory folder;
    std::shared_ptr<const MeshSource> source;
    PolygonMesh mesh;
    {
        const MeshFile file = moved_file(folder.with("a.obj", before));
        source = file.source;
        mesh = file.mesh;
    }
    PolygonMesh further = mesh;
    further.add_face(std::array{0, 1, 2});
    const std::string its_path = (folder / "a.obj").string();
    CHECK_THROWS_WITH_AS(write_mesh_like(*source, folder / "b.obj", further),
                         doctest::Contains(("cannot be written in the form of " + its_path).c_str()), OutputError);
    write_mesh_like(*source, folder / "b.obj", mesh);
    CHECK(content_of(folder / "b.obj") == file_after);
}
