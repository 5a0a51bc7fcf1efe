#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/files/output_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

TEST_CASE("places where no file can be made are refused")
{
    const test::TemporaryDirectory directory;
    CHECK_NOTHROW(require_writable(directory / "new.obj"));
    CHECK_NOTHROW(require_writable(directory.with("old.obj", "")));
    CHECK_THROWS_AS(require_writable("/dev/null"), OutputError);
    CHECK_THROWS_AS(require_writable(directory / "nowhere/new.obj"), OutputError);
    CHECK_THROWS_AS(require_writable(directory / ""), OutputError);
    CHECK_THROWS_AS(require_writable(directory.with("file", "") / "new.obj"), OutputError);
}

TEST_CASE("one file under two names is noticed")
{
    const test::TemporaryDirectory directory;
    CHECK_NOTHROW(require_different({directory / "a", directory / "b"}));
    CHECK_THROWS_AS(require_different({directory / "a", directory / "b", directory / "./a"}), OptionError);
}

TEST_CASE("STL takes triangles without lonely vertices")
{
    PolygonMesh mesh;
    mesh.vertices = Points::Random(4, 3);
    mesh.add_face(std::vector<Index>{0, 1, 2});
    const FileKind stl{FileFormat::Stl, Encoding::Ascii};
    CHECK_THROWS_AS(require_storable(mesh, "m.stl", stl), OutputError);
    mesh.add_face(std::vector<Index>{1, 2, 3});
    CHECK_NOTHROW(require_storable(mesh, "m.stl", stl));
    mesh.add_face(std::vector<Index>{0, 1, 2, 3});
    CHECK_THROWS_AS(require_storable(mesh, "m.stl", stl), OutputError);
    CHECK_NOTHROW(require_storable(mesh, "m.obj", FileKind{}));
}

TEST_CASE("text is written whole, over an old file too")
{
    const test::TemporaryDirectory directory;
    const auto path = directory.with("report.json", "a longer old text");
    write_text(path, "new\n");
    CHECK(test::content_of(path) == "new\n");
    CHECK_THROWS_AS(write_text(directory / "nowhere/report.json", "new\n"), OutputError);
    CHECK_THROWS_AS(write_text("/dev/full", "new\n"), OutputError);
}
