#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "samples/files/mesh_results.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using test::TemporaryDirectory;

namespace {

const std::string textured = "v 0 0 0\nv 1.0 0 0\nv 0 1 0\nvt 0 1\ng half\nf 1/1 2/1 3/1\n";

}  // namespace

TEST_CASE("a result has the form of the input where the format is the same and the sub-meshes are joined")
{
    const TemporaryDirectory folder;
    const MeshFile input = read_mesh(folder.with("a.obj", textured));
    CHECK(MeshOutput(folder / "b.OBJ", input).write(input.mesh, nullptr).empty());
    CHECK(test::content_of(folder / "b.OBJ") == textured);
    MeshOutput(folder / "b.off", input).write(input.mesh, nullptr);
    CHECK(test::content_of(folder / "b.off") == "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    PolygonMesh separated = input.mesh;
    separated.add_face(std::vector<Index>{2, 1, 0});
    MeshOutput(folder / "c.obj", input).write(input.mesh, &separated);
    CHECK(test::content_of(folder / "c.obj") == "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
}

TEST_CASE("a remark says what a result in another format, or of separated sub-meshes, does not have")
{
    using List = std::vector<std::string>;
    const TemporaryDirectory folder;
    const MeshFile input = read_mesh(folder.with("a.obj", textured));
    CHECK(MeshOutput("b.obj", input).remarks_on_losses(true).empty());
    CHECK(MeshOutput("b.ply", input).remarks_on_losses(true) ==
          List{"b.ply lacks the input's data besides the surface: texture coordinates, groups; an output of the "
               "input's format keeps them"});
    CHECK(MeshOutput("b.obj", input).remarks_on_losses(false) ==
          List{"b.obj lacks the input's data besides the surface: texture coordinates, groups; joined sub-meshes, in "
               "the input's format, keep them"});
    const MeshFile plain = read_mesh(folder.with("p.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    CHECK(MeshOutput("b.ply", plain).remarks_on_losses(true).empty());
}

TEST_CASE("colours of OBJ and OFF files arrive in PLY files as bytes, whichever way they are written")
{
    const test::TemporaryDirectory directory;
    const auto obj = [&](const char* red, const char* mixed) {
        return directory.with("a.obj", fmt::format("v 0 0 0 {0}\nv 1 0 0 {1}\nv 0 1 0 {0}\nf 1 2 3\n", red, mixed));
    };
    const auto off = directory.with("a.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 51 102 255 255\n"
                                             "0 1 0 255 0 0 255\n3 0 1 2\n");
    const auto ply = directory / "b.ply";
    const auto check = [&](const std::filesystem::path& input) {
        CAPTURE(input.string());
        const MeshFile file = read_mesh(input);
        CHECK(MeshOutput(ply, file).remarks_on_losses(true).empty());
        MeshOutput(ply, file).write(file.mesh, nullptr);
        CHECK(test::content_of(ply).find("property uchar red\nproperty uchar green\nproperty uchar blue\n") !=
              std::string::npos);
        const FileFields colours = read_fields(*read_mesh(ply).source, std::vector<std::string>{"colour"});
        CHECK(colours.values == (Eigen::MatrixXd(3, 3) << 255, 0, 0, 51, 102, 255, 255, 0, 0).finished());
        CHECK(MeshOutput(directory / "b.stl", file).remarks_on_losses(true).size() == 1);
    };
    check(off);
    check(obj("255 0 0", "51 102 255"));
    check(obj("1 0 0", "0.2 0.4 1.0"));
}
