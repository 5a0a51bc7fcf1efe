// Files that ranks read and write together, beside the same on one machine.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/files/shared_mesh_file.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/thread_communicator.h"
#include "engine/measure/surface_measures.h"
#include "partition/errors.h"
#include "partition/io/slices.h"
#include "tests/support/flows.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

constexpr FileSharing whole{.block = 64};
constexpr FileSharing sliced{.whole_up_to = 0, .block = 64};

/// What ranks have read and written.
struct Shared {
    PolygonMesh mesh;
    std::vector<Index> least_faces;
    std::string written;
    /// A file with labels.
    std::string labelled;
    std::vector<std::string> remarks;
    /// Of all of them; empty: there was none.
    std::string fault;
};

void lift(Points& points)
{
    for (Index v = 0; v < points.rows(); ++v)
        points(v, 2) += 0.1 * std::sin(10.0 * points(v, 0));
}

/// Reads a file, moves the vertices and writes it as `result`.
Shared pass_through(const std::filesystem::path& file, const std::filesystem::path& result, int n,
                    const FileSharing& sharing)
{
    Shared shared;
    std::mutex mutex;
    std::vector<std::string> faults;
    run_on_threads(n, [&](Communicator& communicator) {
        std::string fault;
        try {
            run_together(communicator, [&](Conversation& talk) {
                const auto opened = open_together(talk, file, sharing);
                RankSlice slice = opened->read(talk);
                const PolygonMesh mesh = gather_mesh(talk, slice);
                lift(slice.vertices);
                const auto remarks = opened->write(talk, result, slice.vertices);
                std::vector<Index> labels(at(slice.n_faces()));
                for (Index f = 0; f < slice.n_faces(); ++f)
                    labels[f] = static_cast<Index>(slice.corners[slice.face_offsets[f]] % 7);
                opened->write_labelled(talk, file.parent_path() / "labelled.ply", slice.vertices, labels);
                const std::scoped_lock lock(mutex);
                shared.least_faces.push_back(slice.n_faces());
                if (talk.rank() > 0)
                    return;
                shared.mesh = mesh;
                shared.remarks = remarks;
            });
        } catch (const std::exception& error) {
            fault = error.what();
        }
        const std::scoped_lock lock(mutex);
        faults.push_back(fault);
    });
    for (const std::string& fault : faults)
        CHECK(fault == faults.front());
    shared.fault = faults.front();
    if (shared.fault.empty()) {
        shared.written = test::content_of(result);
        shared.labelled = test::content_of(file.parent_path() / "labelled.ply");
    }
    return shared;
}

void check_as_on_one_machine(const std::filesystem::path& file, const std::filesystem::path& result,
                             const FileSharing& sharing, Index least_faces)
{
    MeshFile expected = read_mesh(file);
    PolygonMesh moved = expected.mesh;
    lift(moved.vertices);
    std::vector<std::string> remarks;
    if (kind_for_writing(result, expected.kind).format == expected.kind.format)
        remarks = write_mesh_like(*expected.source, result, moved);
    else
        write_mesh(result, moved, kind_for_writing(result, expected.kind));
    const std::string written = test::content_of(result);
    std::vector<Index> labels;
    for (Index f = 0; f < moved.n_faces(); ++f)
        labels.push_back(moved.face(f).front() % 7);
    write_labelled_ply(result.parent_path() / "labelled.ply", moved, labels);
    const std::string labelled = test::content_of(result.parent_path() / "labelled.ply");
    for (const int n : {1, 2, 3, 5}) {
        CAPTURE(n);
        const Shared shared = pass_through(file, result, n, sharing);
        REQUIRE(shared.fault.empty());
        CHECK(test::identical(shared.mesh, expected.mesh));
        CHECK((shared.written == written));
        CHECK((shared.labelled == labelled));
        CHECK(shared.remarks == remarks);
        CHECK(std::ranges::min(shared.least_faces) >= least_faces);
    }
}

void write_file(const std::filesystem::path& path, const std::string& content)
{
    std::ofstream(path, std::ios::binary) << content;
}

/// Little-endian.
template <class Value>
void append(std::string& bytes, Value value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

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
    const Shared shared = pass_through(directory / "in.obj", directory / "out.obj", 2, sliced);
    CHECK(shared.written.ends_with(normals + faces));
    REQUIRE(shared.remarks.size() == 1);
    CHECK(test::contains(shared.remarks.front(), "the 2 normals (vn) of"));
}

TEST_CASE("faults of slices of OBJ files are those that one machine finds first, with their lines")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.obj";
    const std::string good = varied_obj(300, "\n") + "\n";
    const auto middle = good.find('\n', good.size() / 2) + 1;
    std::vector<std::string> bad = {"# nothing\n\n", "g nothing\n# here"};
    for (const std::string fault : {"v 1 2\n", "v 1 2 nan\n", "f 1 2\n", "f 1 2 1\n", "f 1 2 0\n", "f 1 2 -100000\n",
                                    "f 1 2 3x\n", "f 1 2 100000\n", "f 1 2 9999999999\n", "v 1 2 3 4 5 6 7 8 9\n"}) {
        bad.push_back(good + fault);
        bad.push_back(good.substr(0, middle) + "# \\\n" + fault + good.substr(middle));
        bad.push_back(fault + good);
        // The other one is found first: by one machine at the end of all lines.
        bad.push_back("f 1 2 5000\n" + good + fault);
        bad.push_back(good.substr(0, middle) + fault + good.substr(middle) + "f 1 2 1\nf 1 2 6000\n");
    }
    for (const std::string& content : bad) {
        write_file(file, content);
        std::string expected;
        try {
            static_cast<void>(read_mesh(file));
        } catch (const InputError& error) {
            expected = error.what();
        }
        CAPTURE(expected);
        REQUIRE(!expected.empty());
        for (const int n : {1, 2, 3, 5}) {
            CAPTURE(n);
            CHECK(pass_through(file, directory / "out.obj", n, sliced).fault == expected);
        }
    }
    CHECK(!std::filesystem::exists(directory / "out.obj"));
}

TEST_CASE("ranks read and write slices of binary STL files as one machine does")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    const FileKind binary{FileFormat::Stl, Encoding::BinaryLittleEndian};
    write_mesh(file, make_triangles(700), binary);
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
    for (const std::string& content : bad) {
        CAPTURE(content.size());
        write_file(file, content);
        std::string expected;
        try {
            static_cast<void>(read_mesh(file));
        } catch (const InputError& error) {
            expected = error.what();
        }
        CAPTURE(expected);
        REQUIRE(!expected.empty());
        for (const int n : {1, 2, 3, 5}) {
            CAPTURE(n);
            CHECK(pass_through(file, directory / "out.stl", n, sliced).fault == expected);
        }
    }
}

TEST_CASE("a result that binary STL cannot hold is refused as on one machine")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.stl";
    const auto result = directory / "out.stl";
    const FileKind binary{FileFormat::Stl, Encoding::BinaryLittleEndian};
    write_mesh(file, make_triangles(700), binary);
    const PolygonMesh mesh = read_mesh(file).mesh;
    const auto last_face = mesh.face(mesh.n_faces() - 1);
    for (const bool is_large : {true, false}) {
        PolygonMesh moved = mesh;
        if (is_large)
            moved.vertices(mesh.n_vertices() - 2, 1) = 1e40;
        moved.vertices.row(last_face[1]) = moved.vertices.row(last_face[2]);
        std::string expected;
        try {
            write_mesh(result, moved, binary);
        } catch (const OutputError& error) {
            expected = error.what();
        }
        REQUIRE(!expected.empty());
        for (const int n : {1, 2, 3, 5}) {
            CAPTURE(n);
            run_on_threads(n, [&](Communicator& communicator) {
                CHECK_THROWS_WITH_AS(run_together(communicator,
                                                  [&](Conversation& talk) {
                                                      const auto opened = open_together(talk, file, sliced);
                                                      static_cast<void>(opened->read(talk));
                                                      opened->write(talk, result,
                                                                    hand_out(talk, moved, sliced.block).vertices);
                                                  }),
                                     expected.c_str(), OutputError);
            });
        }
        CHECK(!std::filesystem::exists(result));
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
        CHECK(read_mesh(directory / "out.ply").mesh.vertices.allFinite());
    }
}

TEST_CASE("the file may be written over itself, and is not touched by a failure")
{
    const test::TemporaryDirectory directory;
    const auto file = directory / "in.ply";
    write_mesh(file, make_triangles(700), {FileFormat::Ply, Encoding::BinaryLittleEndian});
    const std::string before = test::content_of(file);
    const Shared refused = pass_through(file, directory / "nowhere" / "out.ply", 3, sliced);
    CHECK(test::contains(refused.fault, "nowhere"));
    const Shared expected = pass_through(file, directory / "out.ply", 1, sliced);
    const Shared over = pass_through(file, file, 3, sliced);
    // The file, the other, and the one with labels.
    CHECK(over.fault.empty());
    CHECK((test::content_of(file) == expected.written));
    CHECK((before != expected.written));
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 3);
}

TEST_CASE("faults of slices are those that one machine finds")
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
        for (const std::string& content : bad) {
            CAPTURE(content.size());
            write_file(file, content);
            std::string expected;
            try {
                static_cast<void>(read_mesh(file));
            } catch (const InputError& error) {
                expected = error.what();
            }
            REQUIRE(!expected.empty());
            for (const int n : {1, 2, 3, 5}) {
                CAPTURE(n);
                CHECK(pass_through(file, directory / "out.ply", n, sliced).fault == expected);
            }
        }
    }
}

TEST_CASE("a file that changes while it is used is noticed")
{
    const test::TemporaryDirectory directory;
    for (const std::string extension : {".ply", ".obj", ".stl"}) {
        CAPTURE(extension);
        const auto file = directory / ("in" + extension);
        const auto result = directory / ("out" + extension);
        write_mesh(file, make_triangles(700), kind_for_writing(file, {FileFormat::Off, Encoding::Ascii}));
        const std::size_t size = test::content_of(file).size();
        for (const std::size_t place : {size / 4, size - 2}) {
            std::string fault;
            run_on_threads(3, [&](Communicator& communicator) {
                try {
                    run_together(communicator, [&](Conversation& talk) {
                        const auto opened = open_together(talk, file, sliced);
                        const RankSlice slice = opened->read(talk);
                        talk.at_first_rank([&] {
                            std::fstream changed(file, std::ios::binary | std::ios::in | std::ios::out);
                            changed.seekp(static_cast<std::streamoff>(place)) << 'x';
                        });
                        opened->write(talk, result, slice.vertices);
                    });
                } catch (const InputError& error) {
                    if (communicator.rank() == 0)
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
    for (const std::string name : {"in.off", "in.obj.gz"}) {
        write_mesh(directory / name, make_triangles(300), kind_for_writing(directory / name, FileKind{}));
        CHECK(test::contains(pass_through(directory / name, directory / "o.obj", 3, sliced).fault,
                             "convert it to a binary .ply or an .obj file"));
    }
    write_mesh(directory / "in.ply", make_triangles(300), {FileFormat::Ply, Encoding::Ascii});
    CHECK(test::contains(pass_through(directory / "in.ply", directory / "o.ply", 3, sliced).fault,
                         "export it as a binary PLY file"));
    write_mesh(directory / "in.stl", make_triangles(300), {FileFormat::Stl, Encoding::Ascii});
    CHECK(test::contains(pass_through(directory / "in.stl", directory / "o.stl", 3, sliced).fault,
                         "export it as a binary STL file"));
}

TEST_CASE("sizes of a mesh that ranks have are those of one machine, bit for bit")
{
    PolygonMesh mesh = make_mixed_polygons(20'000);
    mesh.vertices.array() += 0.3;
    const MeshSize expected = size_of(mesh);
    PolygonMesh moved = mesh;
    lift(moved.vertices);
    for (const int n : {1, 2, 3, 5})
        run_on_threads(n, [&](Communicator& communicator) {
            run_together(communicator, [&](Conversation& talk) {
                RankSlice slice = hand_out(talk, mesh, block_size);
                const SharedMeshSize size = measure(talk, slice);
                CHECK(size.vertices == mesh.n_vertices());
                CHECK(size.faces == mesh.n_faces());
                CHECK(size.area == expected.area);
                CHECK(size.mean_edge == expected.mean_edge);
                CHECK(size.diagonal == extent_of(mesh.vertices));
                const Points before = slice.vertices;
                lift(slice.vertices);
                CHECK(measure_moves(talk, before, slice.vertices).max ==
                      (moved.vertices - mesh.vertices).rowwise().norm().maxCoeff());
                if (!slice.corners.empty())
                    slice.corners.front() = mesh.n_vertices();
                CHECK_THROWS_WITH_AS(measure(talk, slice), doctest::Contains("face 0 (numbered from 0) names vertex"),
                                     InputError);
            });
        });
}
