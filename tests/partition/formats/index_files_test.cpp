#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/index_files.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

struct Files {
    test::TemporaryDirectory directory;

    [[nodiscard]] std::filesystem::path with(const std::string& name, const std::string& text) const
    {
        std::ofstream(directory / name) << text;
        return directory / name;
    }

    [[nodiscard]] std::vector<Index> read(const std::string& name, const std::string& text, Index n_vertices,
                                          std::string_view property = "fixed") const
    {
        return read_vertex_set(with(name, text), n_vertices, property);
    }

    /// What is said against the file, after its name.
    [[nodiscard]] std::string refusal(const std::string& name, const std::string& text, Index n_vertices,
                                      std::string_view property = "fixed") const
    {
        return message_at(directory / name, [&] { static_cast<void>(read(name, text, n_vertices, property)); });
    }

    [[nodiscard]] std::string refusal_of_labels(const std::string& text, Index n_faces) const
    {
        const auto path = with("a.txt", text);
        return message_at(path, [&] { static_cast<void>(read_labels(path, n_faces)); });
    }

    template <class Read>
    static std::string message_at(const std::filesystem::path& path, Read&& read)
    {
        const std::string message = test::message_of<InputError>(read);
        CHECK((message.empty() || message.starts_with(path.string() + ":")));
        return message.substr(std::min(message.size(), path.string().size()));
    }
};

const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty list uchar int tags\n"
                           "property uchar fixed\nproperty float quality\nend_header\n";

}  // namespace

TEST_CASE("labels are read, one a line, with comments and blank lines between")
{
    const Files files;
    const auto path = files.with("a.txt", "# two parts\n0\n\n 1 \t# here the second begins\r\n1\r\n2147483647");
    CHECK(read_labels(path, 4) == std::vector<Index>{0, 1, 1, 2147483647});
}

TEST_CASE("a bad line of a labels file is named")
{
    const Files files;
    CHECK(files.refusal_of_labels("0\n1.5\n", 2).starts_with(":2: '1.5' is not a label"));
    CHECK(files.refusal_of_labels("0 1\n", 2).starts_with(":1: '0 1' is not a label"));
    CHECK(files.refusal_of_labels("\n\nx\n", 1).starts_with(":3: 'x' is not a label"));
    CHECK(files.refusal_of_labels("0\n-4\n", 2).starts_with(":2: '-4' is negative"));
    CHECK(files.refusal_of_labels("99999999999\n", 1).starts_with(":1: '99999999999' is too large"));
}

TEST_CASE("too few and too many labels are refused")
{
    const Files files;
    CHECK(files.refusal_of_labels("0\n1\n", 3).starts_with(":2: the file ends after 2 of 3 labels"));
    CHECK(files.refusal_of_labels("0\n1\n1\n", 2).starts_with(":3: more labels than the mesh has faces (2)"));
    CHECK(files.refusal_of_labels("", 1).starts_with(":1: the file ends after 0 of 1 labels"));
}

TEST_CASE("labels files that cannot be read are refused")
{
    CHECK_THROWS_AS(read_labels("/nonexistent/labels.txt", 1), InputError);
    CHECK_THROWS_AS(read_labels(std::filesystem::temp_directory_path(), 1), InputError);
}

TEST_CASE("numbers of vertices are read, one a line, in any order and as often as they come")
{
    const Files files;
    CHECK(files.read("a.txt", "# rim\n7\n\n 3 # corner\r\n7\n0", 8) == std::vector<Index>{0, 3, 7});
    CHECK(files.read("a.txt", "", 8).empty());
}

TEST_CASE("bad lines of a set of vertices are named")
{
    const Files files;
    CHECK(files.refusal("a.txt", "1\n8\n", 8).starts_with(":2: there is no vertex 8"));
    CHECK(files.refusal("a.txt", "1 2\n", 8).starts_with(":1: '1 2' is not the number of a vertex"));
    const std::string zero = std::string("1").append(1, '\0').append("2\n");
    CHECK(files.refusal("a.txt", zero, 8).starts_with(":1: '1?2' is not the number of a vertex"));
    CHECK(files.refusal("a.txt", "-1\n", 8).starts_with(":1: '-1' is negative"));
    CHECK(files.refusal("a.txt", "99999999999\n", 8).starts_with(":1: '99999999999' is too large"));
    CHECK_THROWS_AS(read_vertex_set(files.directory / "none.txt", 8, "fixed"), InputError);
}

TEST_CASE("a property of a PLY file says which vertices are meant")
{
    const Files files;
    const std::string text = header + "0.5 2 7 7 1 0\n0.5 0 0 0.25\n0.5 1 9 255 -1\n";
    CHECK(files.read("a.ply", text, 3) == std::vector<Index>{0, 2});
    CHECK(files.read("A.PLY", text, 3, "quality") == std::vector<Index>{1, 2});
    CHECK(files.refusal("a.ply", text, 4).find("has 3 vertices, but the mesh has 4") != std::string::npos);
    CHECK(files.refusal("a.ply", text, 3, "locked").find("'locked', but x, tags, fixed, quality") != std::string::npos);
    CHECK_FALSE(files.refusal("a.ply", text, 3, "tags").empty());
    CHECK(files.refusal("a.ply", header + "0.5 0 1 nan\n0.5 0 0 0\n0.5 0 0 0\n", 3, "quality").find("not a number") !=
          std::string::npos);
    CHECK_FALSE(files.refusal("a.ply", header + "0.5 0 1 1\n", 3).empty());
    CHECK_FALSE(files.refusal("a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n", 3).empty());
}

TEST_CASE("binary PLY files, too")
{
    const Files files;
    const PolygonMesh mesh = test::quad_grid(4, 3);
    std::vector<double> values(mesh.n_vertices(), 0.0);
    values[5] = values[11] = 1.0;
    const std::vector<Colour> grey(values.size(), Colour{128, 128, 128});
    const std::vector<VertexValues> named{{"fixed", values}};
    write_valued_ply(files.directory / "b.ply", mesh, grey, named);
    CHECK(read_vertex_set(files.directory / "b.ply", mesh.n_vertices(), "fixed") == std::vector<Index>{5, 11});
    CHECK(read_vertex_set(files.directory / "b.ply", mesh.n_vertices(), "red").size() == values.size());
}

TEST_CASE("weights of vertices come one a line, or as a property of a .ply")
{
    const Files files;
    const auto read = [&](const std::string& name, const std::string& text, Index n) {
        return read_vertex_weights(files.with(name, text), n, "weight");
    };
    CHECK(read("w.txt", "# w\n0.5\n\n2e3 # stiff\n0\n", 3) == std::vector<double>{0.5, 2e3, 0.0});
    CHECK(read("w.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty double weight\nend_header\n"
               "7 1.25\n8 0\n",
               2) == std::vector<double>{1.25, 0.0});
    const auto refusal = [&](const std::string& name, const std::string& text, Index n) {
        return Files::message_at(files.directory / name, [&] { static_cast<void>(read(name, text, n)); });
    };
    CHECK(refusal("a.txt", "1\n-2\n", 2).starts_with(":2: '-2' is not a weight: "));
    CHECK(refusal("a.txt", "inf\n", 1).starts_with(":1: 'inf' is not a weight: "));
    CHECK(refusal("a.txt", "1\n2\n3\n", 2).starts_with(":3: more weights than the mesh has vertices (2): "));
    CHECK(refusal("a.txt", "1\n2\n", 3).starts_with(":2: the file ends after 2 of 3 weights: "));
    CHECK(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float weight\nend_header\n-1\n", 1)
              .find("is not a weight") != std::string::npos);
}
