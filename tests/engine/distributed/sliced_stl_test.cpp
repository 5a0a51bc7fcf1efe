// STL files of which every rank reads and writes a slice.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/files/open_together.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/io/slices.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::append;
using test::check_as_on_one_machine;
using test::check_fault_as_on_one_machine;
using test::check_faults_as_on_one_machine;
using test::sliced;
using test::write_file;

namespace {

constexpr FileKind binary_stl{FileFormat::Stl, Encoding::BinaryLittleEndian};
constexpr FileKind text_stl{FileFormat::Stl, Encoding::Ascii};

/// One of a strip; two corners of it are one if it has no area.
std::string facet(int f, bool is_degenerate, const std::string& end)
{
    const auto corner = [&](int v) {
        return "  vertex " + std::to_string(v / 2) + " " + std::to_string(v % 2) + " 0.1" + end;
    };
    return "facet normal 0 0 1" + end + " outer loop" + end + corner(f) + corner(f + 1) +
           corner(is_degenerate ? f : f + 2) + " endloop" + end + "endfacet" + end;
}

/// Two strips, each a solid, with empty lines and capitals.
std::string varied_stl(int n_facets, const std::string& end)
{
    std::string content = "SOLID one" + end;
    for (int f = 0; f < n_facets; ++f) {
        content += facet(f, false, end);
        if (f % 5 == 0)
            content += " " + end;
        if (f % 50 == 25)
            content += "end solid" + end + end + "solid facet" + end + "color 1 0 0" + end;
    }
    return content + "EndSolid";
}

}  // namespace

TEST_CASE("ranks read and write slices of binary STL files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    write_mesh(file, make_triangles(700), binary_stl);
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    // Every rank has a facet at the same two corners, and others alone; one of the two has both signs of zero.
    std::string fan = std::string(80, ' ');
    append(fan, std::uint32_t{500});
    for (int f = 0; f < 500; ++f) {
        const float zero = f % 3 == 1 ? -0.0F : 0.0F;
        const auto x = static_cast<float>(f / 2);
        for (const float number :
             {0.F, 0.F, 0.F, zero, 0.F, zero, 0.F, 0.F, 1.F, x + 1.F, f % 2 == 0 ? 1.F : -1.F, 0.F})
            append(fan, number);
        append(fan, std::int16_t{7});
    }
    write_file(file, fan + "\n");
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
}

TEST_CASE("faults of slices of binary STL files are those that one machine finds")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    write_mesh(file, make_triangles(700), {FileFormat::Stl, Encoding::BinaryLittleEndian});
    const std::string good = test::content_of(file);
    std::vector<std::string> bad = {std::string("no STL"), good.substr(0, good.size() - 20), good + "more",
                                    std::string(84, '\0')};
    const std::size_t n_facets = (good.size() - 84) / 50;
    for (const std::size_t facet : {std::size_t{0}, n_facets / 2, n_facets - 1})
        for (const std::size_t other : {facet, n_facets / 3}) {
            std::string damaged = good;
            // Not a number; and the first corner as the second.
            damaged.replace(84 + 50 * facet + 12 + 16, 4, "\xff\xff\xff\xff");
            damaged.replace(84 + 50 * other + 12, 12, good.substr(84 + 50 * other + 24, 12));
            bad.push_back(damaged);
        }
    for (const std::string& content : bad)
        check_fault_as_on_one_machine(file, content);
}

TEST_CASE("a result that STL cannot hold is refused as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    const auto result = directory / "out.stl";
    write_mesh(file, make_triangles(700), binary_stl);
    const MeshFile read = read_mesh(file);
    PolygonMesh moved = read.mesh;
    moved.vertices(moved.n_vertices() - 2, 1) = 1e40;
    std::string expected;
    try {
        write_mesh_like(*read.source, result, moved);
    } catch (const OutputError& error) {
        expected = error.what();
    }
    REQUIRE(!expected.empty());
    for (const int n : {1, 2, 3, 5}) {
        CAPTURE(n);
        run_on_threads(n, [&](Transport& transport) {
            const auto work = [&](Communicator& comm) {
                const auto opened = open_together(comm, file, sliced);
                static_cast<void>(opened->read(comm));
                opened->write(comm, result, hand_out(comm, moved, sliced.block).vertices);
            };
            CHECK_THROWS_WITH_AS(run_together(transport, work), expected.c_str(), OutputError);
        });
    }
    CHECK(!std::filesystem::exists(result));
}

TEST_CASE("facets that become lines are written, and told of, as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    for (const FileKind& kind : {binary_stl, text_stl}) {
        write_mesh(file, make_triangles(700), kind);
        const MeshFile read = read_mesh(file);
        PolygonMesh moved = read.mesh;
        for (const Index f : {3, moved.n_faces() - 1})
            moved.vertices.row(moved.face(f)[1]) = moved.vertices.row(moved.face(f)[2]).eval();
        const auto remarks = write_mesh_like(*read.source, directory / "alone.stl", moved);
        REQUIRE(remarks.size() == 1);
        for (const int n : {1, 2, 3, 5}) {
            CAPTURE(n);
            run_on_threads(n, [&](Transport& transport) {
                run_together(transport, [&](Communicator& comm) {
                    const auto opened = open_together(comm, file, sliced);
                    static_cast<void>(opened->read(comm));
                    CHECK(opened->write(comm, directory / "out.stl", hand_out(comm, moved, sliced.block).vertices) ==
                          remarks);
                });
            });
            CHECK(test::content_of(directory / "out.stl") == test::content_of(directory / "alone.stl"));
        }
    }
}

TEST_CASE("ranks read and write slices of text STL files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    write_mesh(file, make_triangles(700), text_stl);
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        write_file(file, "\xEF\xBB\xBF" + varied_stl(600, end));
        check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    }
    // Several pieces for the threads of each rank, and fewer facets than ranks.
    write_file(file, varied_stl(25'000, "\n"));
    REQUIRE(std::filesystem::file_size(file) > 5 * 2 * Slicing{}.bytes);
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    write_file(file, varied_stl(2, "\n"));
    check_as_on_one_machine(file, directory / "out.stl", sliced, 0);
}

TEST_CASE("faults of slices of text STL files are those that one machine finds first, with their lines")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    const std::string good = varied_stl(40, "\n");
    std::vector<std::string> bad = {"solid\nendsolid\n", "solid nothing\n\nendsolid\n\n", good + "more\n"};
    std::vector<std::size_t> lines;
    for (std::size_t line = 0; line != std::string::npos; line = good.find('\n', line)) {
        line += line > 0 ? 1 : 0;
        lines.push_back(line);
    }
    // Around every cut of five ranks there are lines of all kinds.
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t after = i + 1 < lines.size() ? lines[i + 1] : good.size();
        if (i % 3 == 0)
            bad.push_back(good.substr(0, lines[i]));
        if (i % 5 == 0 || good.compare(lines[i], 5, "facet") == 0)
            bad.push_back(good.substr(0, lines[i]) + "endsolid\n" + good.substr(lines[i]));
        if (i % 4 == 0)
            bad.push_back(good.substr(0, lines[i]) + "facet normal 0 0 1\n" + good.substr(lines[i]));
        bad.push_back(good.substr(0, lines[i]) + "vertex 1 2 nan\n" + good.substr(after));
    }
    check_faults_as_on_one_machine(file, bad);
}

TEST_CASE("facets that slices of STL files leave out are told of as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    std::string facets;
    for (int f = 0; f < 700; ++f)
        facets += facet(f, f % 3 == 1, "\n");
    write_file(file, "solid\n" + facets + "endsolid\n");
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    std::filesystem::remove(directory / "out.stl");
    // The one that is left out first, and then a fault; and nothing else.
    check_fault_as_on_one_machine(file, "solid\n" + facets + "endsolid\nmore\n");
    check_fault_as_on_one_machine(file, "solid\n" + facet(0, true, "\n") + facet(1, true, "\n") + "endsolid\n");

    write_mesh(file, make_triangles(700), binary_stl);
    std::string bytes = test::content_of(file);
    for (std::size_t f = 1; 84 + 50 * f < bytes.size(); f += f % 2 == 0 ? 3 : 4)
        bytes.replace(84 + 50 * f + 12, 12, bytes.substr(84 + 50 * f + 24, 12));
    write_file(file, bytes);
    check_as_on_one_machine(file, directory / "out.stl", sliced, 64);
    std::filesystem::remove(directory / "out.stl");
    for (std::size_t f = 0; 84 + 50 * f < bytes.size(); ++f)
        bytes.replace(84 + 50 * f + 12, 12, bytes.substr(84 + 50 * f + 24, 12));
    check_fault_as_on_one_machine(file, bytes);
}
