// Text files of OFF and PLY of which every rank reads and writes a slice.

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
using test::check_faults_as_on_one_machine;
using test::sliced;
using test::write_file;

namespace {

/// The corners of a strip of quads, some of which are two triangles: lines as in OFF.
std::vector<std::string> faces_of_strip(int n_columns)
{
    std::vector<std::string> faces;
    for (int c = 0; c + 1 < n_columns; ++c) {
        const auto corner = [&](int k) { return " " + std::to_string(2 * c + k); };
        if (c % 3 == 2) {
            faces.push_back("3" + corner(0) + corner(2) + corner(1));
            faces.push_back("3" + corner(1) + corner(2) + corner(3));
        } else {
            faces.push_back("4" + corner(0) + corner(2) + corner(3) + corner(1));
        }
    }
    return faces;
}

std::string position_in_strip(int v)
{
    return std::to_string(v / 2) + (v % 4 == 0 ? ".0" : "") + " " + (v % 2 == 0 ? "0" : "1e0") + " +0";
}

/// The strip with comments, empty lines and further numbers.
/// @param keyword what stands before the counts.
std::string varied_off(int n_columns, const std::string& keyword, const std::string& end)
{
    const std::vector<std::string> faces = faces_of_strip(n_columns);
    std::string text = "# made by hand" + end + keyword + std::to_string(2 * n_columns) + " " +
                       std::to_string(faces.size()) + " 0 # counts" + end + end;
    for (int v = 0; v < 2 * n_columns; ++v)
        text += position_in_strip(v) + (v % 5 == 0 ? " \t0.5 0.25" : "") + (v % 7 == 0 ? " # seven" + end : end) +
                (v % 11 == 0 ? "  " + end + "#" + end : "");
    for (std::size_t f = 0; f < faces.size(); ++f)
        text += faces[f] + (f % 4 == 0 ? " 255 0 0" : "") + end + (f % 9 == 0 ? end : "");
    return text + "# the end";
}

std::string vertices_of_ply(int n, const std::string& end)
{
    std::string text;
    for (int v = 0; v < n; ++v)
        text += (v % 2 == 0 ? "2 8 9 " : "0 ") + position_in_strip(v) + " 7" + end + (v % 9 == 0 ? end : "");
    return text;
}

/// The strip among other elements, with lists in its vertices.
std::string varied_ply(int n_columns, const std::string& coordinate, bool faces_come_first, const std::string& end)
{
    const int n = 2 * n_columns;
    const std::vector<std::string> faces = faces_of_strip(n_columns);
    const std::string vertex = "element vertex " + std::to_string(n) + end + "property list uchar int marks" + end +
                               "property " + coordinate + " x" + end + "property float y" + end + "property float z" +
                               end + "property uchar grey" + end;
    const std::string face =
        "element face " + std::to_string(faces.size()) + end + "property list uchar int vertex_indices" + end;
    std::string lines;
    for (const std::string& line : faces)
        lines += line + end;
    const std::string vertices = vertices_of_ply(n, end);
    return "ply" + end + "format ascii 1.0" + end + "element camera 2" + end + "property double focus" + end +
           (faces_come_first ? face + vertex : vertex + face) + "element edge 1" + end + "property list int int path" +
           end + "end_header" + end + "35" + end + "50" + end +
           (faces_come_first ? lines + vertices : vertices + lines) + "3 0 1 2" + end;
}

/// Files with one line more, at the place of another, or one too few: each with a fault.
std::vector<std::string> with_faults(const std::string& good, const std::vector<std::string>& lines)
{
    const auto line_at = [&](std::size_t place) { return good.find('\n', place) + 1; };
    const std::size_t first = line_at(good.size() / 8);
    const std::size_t middle = line_at(good.size() / 2);
    const std::size_t last = line_at(good.size() - 30);
    std::vector<std::string> bad = {good + "1 2 3\n", good.substr(0, middle), good.substr(0, middle - 2),
                                    good.substr(0, last)};
    for (const std::string& line : lines)
        for (const std::size_t place : {first, middle, last}) {
            bad.push_back(good.substr(0, place) + line + good.substr(line_at(place)));
            // The first of two is told of.
            bad.push_back(bad.back() + "more\n");
        }
    return bad;
}

}  // namespace

TEST_CASE("ranks read and write slices of OFF files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.off";
    for (const PolygonMesh& mesh : {make_triangles(700), make_mixed_polygons(700)}) {
        write_mesh(file, mesh, {FileFormat::Off, Encoding::Ascii});
        check_as_on_one_machine(file, directory / "out.off", sliced, 64);
    }
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const std::string keyword : {"OFF ", "COFF", "ST", ""}) {
            CAPTURE(keyword);
            const std::string first = keyword == "ST" ? "STCOFF" + end : keyword == "COFF" ? keyword + end : keyword;
            write_file(file, "\xEF\xBB\xBF" + varied_off(300, first, end));
            check_as_on_one_machine(file, directory / "out.off", sliced, 64);
        }
    // Several pieces for the threads of each rank.
    write_file(file, varied_off(60'000, "OFF\n", "\n"));
    REQUIRE(std::filesystem::file_size(file) > 5 * 2 * Slicing{}.bytes);
    check_as_on_one_machine(file, directory / "out.off", sliced, 64);
    // Fewer lines than ranks.
    write_file(file, "3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2");
    check_as_on_one_machine(file, directory / "out.off", sliced, 0);
}

TEST_CASE("ranks read and write slices of text PLY files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    for (const PolygonMesh& mesh : {make_triangles(700), make_mixed_polygons(700)}) {
        write_mesh(file, mesh, {FileFormat::Ply, Encoding::Ascii});
        check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
    }
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const std::string coordinate : {"float", "short", "double"})
            for (const bool faces_come_first : {false, true}) {
                CAPTURE(coordinate);
                CAPTURE(faces_come_first);
                write_file(file, varied_ply(300, coordinate, faces_come_first, end));
                check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
            }
    write_file(file, varied_ply(60'000, "float", true, "\n"));
    REQUIRE(std::filesystem::file_size(file) > 5 * 2 * Slicing{}.bytes);
    check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
}

TEST_CASE("normals of OFF and text PLY files in slices stay, and a remark says so")
{
    const test::TemporaryDirectory directory;
    const std::string rest = "1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 1 0\n3 0 1 2\n";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    write_file(directory / "in.off", "NOFF\n3 1 0\n" + rest);
    write_file(directory / "in.ply", ply + rest);
    for (const std::string extension : {".off", ".ply"}) {
        const test::Shared shared =
            test::pass_through(directory / ("in" + extension), directory / ("out" + extension), 2, sliced);
        REQUIRE(shared.fault == "");
        CHECK(test::contains(shared.written, " 0 0 1\n"));
        CHECK(shared.written.ends_with(" 0 1 0\n3 0 1 2\n"));
        REQUIRE(shared.remarks.size() == 1);
        CHECK(test::contains(shared.remarks.front(), "stay as they were: ranks"));
    }
}

TEST_CASE("faults of slices of OFF files are those that one machine finds first, with their lines")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.off";
    const std::string good = varied_off(300, "OFF\n", "\n") + "\n";
    check_faults_as_on_one_machine(
        file, with_faults(good, {"x\n", "3 0 1 5000\n", "3 0 -1 2\n", "3 1\n", "0 0 nan\n", "1e999 0 0\n", "\n"}));
    for (const std::string content : {"OFF\n0 0 0\n", "OFF\n0 1 0\n3 0 1 2\n", "OFF\n0 0 0\n# nothing\n\n", "OFF\n",
                                      "OFF\n1 0\n", "# nothing\n", "4OFF\n1 0\n0 0 0 0\n", "OFF\n-1 0\n"})
        check_fault_as_on_one_machine(file, content);
}

TEST_CASE("faults of slices of text PLY files are those that one machine finds first, with their lines")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    for (const bool faces_come_first : {false, true}) {
        const std::string good = varied_ply(300, "float", faces_come_first, "\n");
        check_faults_as_on_one_machine(file,
                                       with_faults(good, {"x\n", "3 0 1 5000\n", "3 0 -1\n", "0 0 0 nan 1\n", "\n"}));
        check_fault_as_on_one_machine(file, good.substr(0, good.find("end_header")));
    }
}

TEST_CASE("faces that slices of text leave out stay in the file, and are told of as on one machine")
{
    const test::TemporaryDirectory directory;
    std::string off = "OFF\n9 700 0\n";
    std::string ply = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 700\nproperty list uchar int vertex_indices\nend_header\n";
    std::string rest;
    for (int v = 0; v < 9; ++v)
        rest += std::to_string(v % 3) + " " + std::to_string(v / 3) + " 0.5\n";
    for (int f = 0; f < 700; ++f) {
        const std::string corner = std::to_string(f % 5);
        rest += f % 3 == 1 ? "2 1 " + corner + "\n" : f % 7 == 3 ? "4 8 1 7 8\n" : "3 8 7 " + corner + "\n";
    }
    write_file(directory / "in.off", off + rest);
    check_as_on_one_machine(directory / "in.off", directory / "out.off", sliced, 64);
    // Rows with too many numbers are told of as well; and a fault that is none of faces wins.
    ply += rest.substr(0, rest.size() - 1) + " 9 9\n";
    ply.replace(ply.find("0 1 0.5\n"), 7, "0 1 0.5 4");
    write_file(directory / "in.ply", ply);
    check_as_on_one_machine(directory / "in.ply", directory / "out.ply", sliced, 64);
    std::filesystem::remove(directory / "out.ply");
    check_fault_as_on_one_machine(directory / "in.ply", ply + "more\n");
}
