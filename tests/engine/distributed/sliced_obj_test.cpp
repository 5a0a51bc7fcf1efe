// OBJ files of which every rank reads and writes a slice.

#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/io/slices.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::check_as_on_one_machine;
using test::check_fault_as_on_one_machine;
using test::sliced;
using test::write_file;

namespace {

/// A strip of quads and triangles, with all that an OBJ file may have besides, faces among the vertices, and vertices
/// that come after their faces.
std::string varied_obj(int n_columns, const std::string& end)
{
    std::string text = "# made by hand" + end + "mtllib colours.mtl" + end;
    for (int c = 0; c < n_columns; ++c) {
        const std::string x = std::to_string(c) + (c % 4 == 0 ? ".0" : "");
        text += "v  " + x + " 0 0" + (c % 5 == 0 ? " \t1 0.5 .25" : "") + end;
        text += "v " + x + (c % 3 == 0 ? " \\" + end : "") + " 1e0 +0 # the other" + end;
        text += "vt 0.5 " + x + end;
        if (c == 0)
            continue;
        const auto v = std::to_string(2 * c - 1);
        if (c % 4 == 0)
            text += "f -4/-2 -2/-1 -1/ -3//" + end;
        else if (c % 4 == 1)
            text += "f " + v + " " + std::to_string(2 * c + 1) + (c % 8 == 1 ? " \\" + end : "") + " " +
                    std::to_string(2 * c) + end + "f -3 -2/1 -1" + end + end;
        else if (c % 4 == 2 && c + 1 < n_columns)
            text += "g part" + end + "f " + v + " " + std::to_string(2 * c + 1) + " " + std::to_string(2 * c + 2) +
                    " " + std::to_string(2 * c) + end;
        else
            text += "l 1 2" + end + "fo -4 -2 -1 -3" + end;
    }
    return text + "# the end";
}

}  // namespace

TEST_CASE("ranks read and write slices of OBJ files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.obj";
    for (const PolygonMesh& mesh : {make_triangles(700), make_mixed_polygons(700)}) {
        write_mesh(file, mesh, FileKind{});
        check_as_on_one_machine(file, directory / "out.obj", sliced, 64);
    }
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        CAPTURE(end == "\n");
        write_file(file, "\xEF\xBB\xBF" + varied_obj(300, end));
        check_as_on_one_machine(file, directory / "out.obj", sliced, 64);
    }
    // Several pieces for the threads of each rank.
    write_file(file, varied_obj(50'000, "\n"));
    REQUIRE(std::filesystem::file_size(file) > 5 * 2 * Slicing{}.bytes);
    check_as_on_one_machine(file, directory / "out.obj", sliced, 64);
    // Fewer lines than ranks, one of them longer than a share.
    write_file(file, "v 0 0 0\nv 1 0 0 \\\n\\\n\\\n1 .5 .5\nv 0 1 0\nf 1 2 3");
    check_as_on_one_machine(file, directory / "out.obj", sliced, 0);
}

TEST_CASE("normals of OBJ files in slices stay, and a remark says so")
{
    const test::TemporaryDirectory directory;
    const std::string normals = "vn 0 0 1\nvn 1 0 0\n";
    const std::string faces = "f 1//1 2//2 3//-1\n";
    write_file(directory / "in.obj", "v 1 0 0\nv 1 1 0\nv 0 1 0\n" + normals + faces);
    const test::Shared shared = test::pass_through(directory / "in.obj", directory / "out.obj", 2, sliced);
    CHECK(shared.written.ends_with(normals + faces));
    REQUIRE(shared.remarks.size() == 1);
    CHECK(test::contains(shared.remarks.front(), "the 2 normals (vn) of"));
}

TEST_CASE("faults of slices of OBJ files are those that one machine finds first, with their lines")
{
    const test::TemporaryDirectory directory;
    const std::string good = varied_obj(300, "\n") + "\n";
    const auto middle = good.find('\n', good.size() / 2) + 1;
    std::vector<std::string> bad = {"# nothing\n\n", "g nothing\n# here"};
    for (const std::string fault : {"v 1 2\n", "v 1 2 nan\n", "f 1 2 0\n", "f 1 2 -100000\n", "f 1 2 3x\n",
                                    "f 1 2 100000\n", "f 1 2 9999999999\n", "v 1 2 3 4 5 6 7 8 9\n"}) {
        bad.push_back(good + fault);
        bad.push_back(good.substr(0, middle) + "# \\\n" + fault + good.substr(middle));
        bad.push_back(fault + good);
        // The other one is found first: by one machine at the end of all lines.
        bad.push_back("f 1 2 5000\n" + good + fault);
        bad.push_back(good.substr(0, middle) + fault + good.substr(middle) + "f 1 2 1\nf 1 2 6000\n");
    }
    for (const std::string& content : bad)
        check_fault_as_on_one_machine(directory / "in.obj", content);
}

TEST_CASE("faces that slices of OBJ files leave out stay in the file, and are told of as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.obj";
    std::string content = varied_obj(300, "\n") + "\n";
    for (int f = 0; f < 900; ++f)
        content += f % 3 == 0 ? "f 1 2\n" : f % 3 == 1 ? "f 3 4 5 4\n" : "f 9 -8 7\n";
    write_file(file, content);
    check_as_on_one_machine(file, directory / "out.obj", sliced, 64);
    std::filesystem::remove(directory / "out.obj");
    check_fault_as_on_one_machine(file, content + "f 1 2 5000\n");
    check_fault_as_on_one_machine(file, content + "f 1 5000\n");
}
