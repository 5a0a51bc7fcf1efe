// Files that ranks read and write together, beside the same on one machine.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/files/open_together.h"
#include "engine/distributed/files/shared_mesh_file.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/measure/surface_measures.h"
#include "partition/errors.h"
#include "partition/io/byte_writer.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::append;
using test::check_as_on_one_machine;
using test::check_fault_as_on_one_machine;
using test::sliced;
using test::write_file;

namespace {

constexpr FileSharing whole{.block = 64};

/// A strip of quads and triangles with all kinds of properties, and elements around.
std::string colourful_ply(int n_columns, const std::string& coordinate)
{
    const int n_vertices = 2 * n_columns;
    const int n_faces = n_columns - 1;
    std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment made by hand\nelement camera 2\n"
                        "property double focus\nelement vertex " +
                        std::to_string(n_vertices) + "\nproperty uchar red\nproperty " + coordinate +
                        " x\nproperty float y\nproperty float z\nproperty short mark\nelement face " +
                        std::to_string(n_faces + n_faces / 3) +
                        "\nproperty int group\nproperty list uchar uint vertex_indices\nproperty list uchar float "
                        "texcoord\nelement edge 1\nproperty list int int path\nend_header\n";
    append(bytes, 35.0);
    append(bytes, 50.0);
    for (int v = 0; v < n_vertices; ++v) {
        append(bytes, static_cast<unsigned char>(v));
        if (coordinate == "int")
            append(bytes, std::int32_t{v / 2});
        else
            append(bytes, 0.1F * static_cast<float>(v / 2));
        append(bytes, static_cast<float>(v % 2));
        append(bytes, 0.0F);
        append(bytes, static_cast<std::int16_t>(-v));
    }
    const auto add_face = [&](const std::vector<int>& corners, int n_textures) {
        append(bytes, std::int32_t{7});
        append(bytes, static_cast<unsigned char>(corners.size()));
        for (const int corner : corners)
            append(bytes, static_cast<std::uint32_t>(corner));
        append(bytes, static_cast<unsigned char>(n_textures));
        for (int k = 0; k < n_textures; ++k)
            append(bytes, 0.5F);
    };
    for (int f = 0; f < n_faces; ++f) {
        const int v = 2 * f;
        if (f % 3 == 2) {
            add_face({v, v + 2, v + 1}, 6);
            add_face({v + 1, v + 2, v + 3}, 0);
        } else {
            add_face({v, v + 2, v + 3, v + 1}, f % 2);
        }
    }
    // One for each third face that is cut in two.
    append(bytes, std::int32_t{2});
    append(bytes, std::int32_t{0});
    append(bytes, std::int32_t{1});
    return bytes + "\n";
}

/// A binary OFF file in one of the four layouts that there are.
std::string binary_off(const PolygonMesh& mesh, std::endian order, bool has_colours)
{
    OutputBuffer file;
    file.text("OFF BINARY\n");
    const auto put = [&](auto value) { file.binary(value, order); };
    for (const Index n : {mesh.n_vertices(), mesh.n_faces(), 0})
        put(static_cast<std::uint32_t>(n));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const double coordinate : mesh.vertices.row(v))
            put(static_cast<float>(coordinate));
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        put(static_cast<std::uint32_t>(mesh.face(f).size()));
        for (const Index corner : mesh.face(f))
            put(std::int32_t{corner});
        if (!has_colours)
            continue;
        put(static_cast<std::uint32_t>(f % 4));
        for (Index k = 0; k < f % 4; ++k)
            put(0.5F);
    }
    return std::string(file.content());
}

}  // namespace

TEST_CASE("ranks read and write small files of every format as one machine does")
{
    const test::TemporaryDirectory directory;
    const PolygonMesh triangles = make_triangles(700);
    const PolygonMesh polygons = make_mixed_polygons(700);
    for (const std::string extension : {".obj", ".off", ".ply", ".stl", ".obj.gz"}) {
        CAPTURE(extension);
        const auto file = directory / ("in" + extension);
        write_mesh(file, extension == ".stl" ? triangles : polygons, kind_for_writing(file, FileKind{}));
        check_as_on_one_machine(file, directory / ("out" + extension), whole, 64);
    }
    write_mesh(directory / "in.obj", polygons, FileKind{});
    check_as_on_one_machine(directory / "in.obj", directory / "other.ply", whole, 64);
}

TEST_CASE("ranks read and write slices of binary PLY files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    for (const Encoding encoding : {Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian})
        for (const PolygonMesh& mesh : {make_triangles(700), make_mixed_polygons(700)}) {
            write_mesh(file, mesh, {FileFormat::Ply, encoding});
            check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
        }
}

TEST_CASE("slices of PLY files keep what else there is, rounded or in wider numbers")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    for (const std::string coordinate : {"float", "int"}) {
        CAPTURE(coordinate);
        write_file(file, colourful_ply(400, coordinate));
        check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
        Points expected = read_mesh(file).mesh.vertices;
        test::lift(expected);
        const double rounding = coordinate == "int" ? 1e-7 : 1e-6;
        CHECK((read_mesh(directory / "out.ply").mesh.vertices - expected).cwiseAbs().maxCoeff() < 400 * rounding);
        const std::string header = test::content_of(directory / "out.ply").substr(0, 500);
        CHECK(header.find(coordinate == "int" ? "property double x" : "property float x") != std::string::npos);
    }
}

TEST_CASE("a face of more corners than a byte counts, on one rank alone, is written by all")
{
    const test::TemporaryDirectory directory;
    PolygonMesh mesh = make_quads(700);
    // A disc beside it, as the last face.
    constexpr Index n_corners = 300;
    const Index first = mesh.n_vertices();
    mesh.vertices.conservativeResize(first + n_corners, 3);
    std::vector<Index> corners;
    for (Index k = 0; k < n_corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / n_corners;
        mesh.vertices.row(first + k) = Point(3.0 + std::cos(angle), std::sin(angle), 0.0);
        corners.push_back(first + k);
    }
    mesh.add_face(corners);
    for (const std::string extension : {".ply", ".obj", ".off"}) {
        CAPTURE(extension);
        const auto file = directory / ("in" + extension);
        const FileKind kind{*format_of(file), extension == ".ply" ? Encoding::BinaryLittleEndian : Encoding::Ascii};
        write_mesh(file, mesh, kind);
        check_as_on_one_machine(file, directory / ("out" + extension), sliced, 64);
        CHECK(read_mesh(directory / "labelled.ply").mesh.face(mesh.n_faces() - 1).size() == n_corners);
    }
}

TEST_CASE("faults of slices of binary PLY files are those that one machine finds")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    write_mesh(file, make_triangles(700), {FileFormat::Ply, Encoding::BinaryLittleEndian});
    const std::string triangles = test::content_of(file);
    write_mesh(file, make_mixed_polygons(700), {FileFormat::Ply, Encoding::BinaryLittleEndian});
    const std::string polygons = test::content_of(file);
    for (const std::string& good : {triangles, polygons}) {
        std::vector<std::string> bad;
        // Somewhere in the vertices, in the faces, and at the end.
        for (const std::size_t place : {good.size() / 4, good.size() / 2, good.size() * 3 / 4, good.size() - 14}) {
            std::string damaged = good;
            for (std::size_t i = 0; i < 24; ++i)
                damaged[place - i] = '\xff';
            bad.push_back(damaged);
            bad.push_back(good.substr(0, place));
        }
        bad.push_back(good + "more");
        for (const std::string& content : bad)
            check_fault_as_on_one_machine(file, content);
    }
}

TEST_CASE("faces that slices of binary PLY files leave out stay in the file, and are told of as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    for (const PolygonMesh& good : {make_triangles(700), make_mixed_polygons(700)}) {
        PolygonMesh mesh = good;
        write_mesh(file, mesh, {FileFormat::Ply, Encoding::BinaryLittleEndian});
        std::string bytes = test::content_of(file);
        // From the end of the file: where a face begins says the mesh.
        for (Index f = mesh.n_faces() - 1, behind = 0; f >= 0; --f) {
            const auto n = static_cast<Index>(mesh.face(f).size());
            behind += 1 + 4 * n;
            if (f % 3 == 1)
                bytes.replace(bytes.size() - at(behind) + 1, 4, bytes.substr(bytes.size() - at(behind) + 5, 4));
        }
        write_file(file, bytes);
        check_as_on_one_machine(file, directory / "out.ply", sliced, 64);
    }
}

TEST_CASE("ranks read and write slices of binary OFF files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.off";
    for (const std::endian order : {std::endian::little, std::endian::big})
        for (const bool has_colours : {false, true})
            for (const PolygonMesh& mesh : {make_triangles(700), make_mixed_polygons(700)}) {
                const std::string good = binary_off(mesh, order, has_colours);
                write_file(file, good + "\n");
                check_as_on_one_machine(file, directory / "out.off", sliced, 64);
                std::vector<std::string> bad = {good.substr(0, good.size() - 5), good + "more"};
                for (const std::size_t place : {good.size() / 5, good.size() / 2, good.size() * 3 / 4}) {
                    bad.push_back(good);
                    bad.back().replace(place, 12, 12, '\xff');
                }
                test::check_faults_as_on_one_machine(file, bad);
            }
    for (const std::string& content :
         {std::string("OFF BINARY\n"), "OFF BINARY\n" + std::string(12, '\0'), "OFF BINARY\n" + std::string(200, '\0')})
        check_fault_as_on_one_machine(file, content);
}

TEST_CASE("a result that binary OFF cannot hold is refused as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.off";
    const auto result = directory / "out.off";
    write_file(file, binary_off(make_triangles(700), std::endian::big, true));
    MeshFile alone = read_mesh(file);
    alone.mesh.vertices(alone.mesh.n_vertices() - 2, 1) = 1e40;
    std::string expected;
    try {
        write_mesh_like(*alone.source, result, alone.mesh);
    } catch (const OutputError& error) {
        expected = error.what();
    }
    REQUIRE(!expected.empty());
    for (const int n : {1, 3})
        run_on_threads(n, [&](Transport& transport) {
            const auto work = [&](Communicator& comm) {
                const auto opened = open_together(comm, file, sliced);
                static_cast<void>(opened->read(comm));
                opened->write(comm, result, hand_out(comm, alone.mesh, sliced.block).vertices);
            };
            CHECK_THROWS_WITH_AS(run_together(transport, work), expected.c_str(), OutputError);
        });
    CHECK(!std::filesystem::exists(result));
}

TEST_CASE("the file may be written over itself, and is not touched by a failure")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    write_mesh(file, make_triangles(700), {FileFormat::Ply, Encoding::BinaryLittleEndian});
    const std::string before = test::content_of(file);
    const test::Shared refused = test::pass_through(file, directory / "nowhere" / "out.ply", 3, sliced);
    CHECK(test::contains(refused.fault, "nowhere"));
    const test::Shared expected = test::pass_through(file, directory / "out.ply", 1, sliced);
    const test::Shared over = test::pass_through(file, file, 3, sliced);
    // The file, the other, and the one with labels.
    CHECK(over.fault.empty());
    CHECK((test::content_of(file) == expected.written));
    CHECK((before != expected.written));
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 3);
}

TEST_CASE("a file that changes while it is used is noticed")
{
    const test::TemporaryDirectory directory;
    for (const std::string extension : {".ply", ".obj", ".stl", ".off"}) {
        CAPTURE(extension);
        const auto file = directory / ("in" + extension);
        const auto result = directory / ("out" + extension);
        write_mesh(file, make_triangles(700), kind_for_writing(file, {FileFormat::Off, Encoding::Ascii}));
        const std::size_t size = test::content_of(file).size();
        // The title of a binary STL file is nobody's.
        for (const std::size_t place : {extension == ".stl" ? size / 8 : 1, size / 4, size - 2}) {
            std::string fault;
            run_on_threads(3, [&](Transport& transport) {
                try {
                    run_together(transport, [&](Communicator& comm) {
                        const auto opened = open_together(comm, file, sliced);
                        const RankSlice slice = opened->read(comm);
                        comm.at_first_rank([&] {
                            std::fstream changed(file, std::ios::binary | std::ios::in | std::ios::out);
                            changed.seekp(static_cast<std::streamoff>(place)) << 'x';
                        });
                        opened->write(comm, result, slice.vertices);
                    });
                } catch (const InputError& error) {
                    if (transport.rank() == 0)
                        fault = error.what();
                }
            });
            CHECK(test::contains(fault, "has been changed since it was read"));
            CHECK(!std::filesystem::exists(result));
            write_mesh(file, make_triangles(700), kind_for_writing(file, {FileFormat::Off, Encoding::Ascii}));
        }
    }
}

TEST_CASE("files that cannot be read in slices are refused with what to do")
{
    const test::TemporaryDirectory directory;
    const auto fault = [&](const std::string& name) {
        return test::pass_through(directory / name, directory / "o.obj", 3, sliced).fault;
    };
    write_mesh(directory / "in.obj.gz", make_triangles(300), FileKind{});
    CHECK(test::contains(fault("in.obj.gz"), "unpack it, so that every rank can read a slice"));
    std::filesystem::rename(directory / "in.obj.gz", directory / "in.obj");
    CHECK(test::contains(fault("in.obj"), "unpack it, so that every rank can read a slice"));
    write_file(directory / "in.txt", "OFF\n");
    CHECK(test::contains(fault("in.txt"), "is not one of .obj, .off, .ply or .stl"));
}

TEST_CASE("sizes of a mesh that ranks have are those of one machine, bit for bit")
{
    PolygonMesh mesh = make_mixed_polygons(20'000);
    mesh.vertices.array() += 0.3;
    const MeshSize expected = size_of(mesh);
    PolygonMesh moved = mesh;
    test::lift(moved.vertices);
    for (const int n : {1, 2, 3, 5})
        run_on_threads(n, [&](Transport& transport) {
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = hand_out(comm, mesh, block_size);
                const SharedMeshSize size = measure(comm, slice);
                CHECK(size.vertices == mesh.n_vertices());
                CHECK(size.faces == mesh.n_faces());
                CHECK(size.area == expected.area);
                CHECK(size.mean_edge == expected.mean_edge);
                CHECK(size.diagonal == extent_of(mesh.vertices));
                const Points before = slice.vertices;
                test::lift(slice.vertices);
                CHECK(measure_moves(comm, before, slice.vertices).max ==
                      (moved.vertices - mesh.vertices).rowwise().norm().maxCoeff());
                if (!slice.corners.empty())
                    slice.corners.front() = mesh.n_vertices();
                CHECK_THROWS_WITH_AS(measure(comm, slice), doctest::Contains("face 0 (numbered from 0) names vertex"),
                                     InputError);
            });
        });
}
