// Files that are read and written in slices: whatever the slices, the same comes of it as in one go.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"
#include "partition/formats/stl.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/backwards.h"
#include "tests/support/mesh_files.h"
#include "tests/support/random_meshes.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using test::content_of;
using test::run_backwards;
using test::TemporaryDirectory;

namespace {

const Slicing in_one_go{};

PolygonMesh read(FileFormat format, std::string_view content, const Slicing& slicing, FaultLog* faults)
{
    switch (format) {
    case FileFormat::Obj:
        return read_obj("a", content, slicing, faults);
    case FileFormat::Off:
        return read_off("a", content, slicing, faults);
    case FileFormat::Ply:
        return read_ply("a", content, slicing, faults).mesh;
    case FileFormat::Glb:
    case FileFormat::Gltf:
        return read_gltf("a", content, slicing, faults);
    case FileFormat::Stl:
        break;
    }
    return read_stl("a", content, slicing, faults).mesh;
}

/// What comes of reading a file.
struct Outcome {
    PolygonMesh mesh;
    std::vector<std::string> messages;
};

/// @param notes whether faults are noted.
Outcome outcome_of(FileFormat format, std::string_view content, const Slicing& slicing, bool notes)
{
    Outcome reading;
    FaultLog faults;
    try {
        reading.mesh = read(format, content, slicing, notes ? &faults : nullptr);
    } catch (const InputError& error) {
        reading.messages.emplace_back(error.what());
    }
    reading.messages.insert(reading.messages.end(), faults.messages.begin(), faults.messages.end());
    return reading;
}

/// Coordinates that are not numbers are the same, too.
bool same_bits(const PolygonMesh& a, const PolygonMesh& b)
{
    return a.n_vertices() == b.n_vertices() && a.face_offsets == b.face_offsets && a.face_vertices == b.face_vertices &&
           std::equal(
               a.vertices.data(), a.vertices.data() + a.vertices.size(), b.vertices.data(),
               [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

void check_reading(FileFormat format, std::string_view content, std::size_t bytes)
{
    CAPTURE(bytes);
    CAPTURE(content);
    for (const bool notes : {false, true}) {
        const Outcome whole = outcome_of(format, content, in_one_go, notes);
        const Outcome sliced = outcome_of(format, content, {run_backwards, bytes}, notes);
        CHECK(sliced.messages == whole.messages);
        CHECK(same_bits(sliced.mesh, whole.mesh));
    }
}

std::vector<std::string> rewrite(FileFormat format, OutputFile& file, std::string_view content, const PolygonMesh& mesh,
                                 const Slicing& slicing)
{
    if (format == FileFormat::Obj)
        return rewrite_obj(file, "a", content, mesh, slicing);
    if (format == FileFormat::Glb)
        return rewrite_gltf(file, "a", content, mesh, slicing);
    return format == FileFormat::Off ? rewrite_off(file, "a", content, mesh, slicing)
                                     : rewrite_ply(file, "a", content, mesh, slicing);
}

test::Rewritten rewritten(FileFormat format, std::string_view content, const PolygonMesh& mesh, const Slicing& slicing)
{
    const TemporaryDirectory folder;
    OutputFile file(folder / "a");
    test::Rewritten result;
    result.remarks = rewrite(format, file, content, mesh, slicing);
    file.commit();
    result.content = content_of(folder / "a");
    return result;
}

struct File {
    FileFormat format;
    std::string content;
};

const std::string ply_header = "ply\nformat ascii 1.0\ncomment a\nelement thing 2\nproperty list uchar int numbers\n"
                               "element vertex 4\nproperty float x\nproperty double nx\nproperty float y\n"
                               "property float z\nproperty float ny\nproperty float nz\nelement face 3\n"
                               "property int label\nproperty list uchar int vertex_indices\nend_header\n";

/// With all that may stand at the edges of a slice.
std::vector<File> good_files()
{
    return {
        {FileFormat::Obj,
         "\xEF\xBB\xBFv 0 0 0\nv 1 \\\n0 \\\n0 # a comment \\\n\n  \nv 0 1 0\nvn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\n"
         "v 0 0 1\nf -4//-1 \\\n-1//-1 -2//-1\ng f 1\nf 1 2 6 3\nusemtl a \\\nf 9\nv 1 1 0\nvn 0 1 0\nv 2 2 2\n"
         "f -1//3 +1//3 2//1\nl 1 2"},
        {FileFormat::Obj, "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0 \\ \r\n 1 0 0\r\nf 1 2 3\r\n"},
        {FileFormat::Obj, "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"},
        {FileFormat::Off, "NOFF # noff\n4 2 0\n\n0 0 0 0 0 1\n# none\n1 0 0 0 0 1\n0 1 0 0 0 1 # last\n1 1 0 0 0 1\n"
                          "3 0 1 2 255 0 0\n\n4 0 1 3 2\n"},
        {FileFormat::Ply, ply_header + "2 1 2\n1 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n\n0 0 1 0 0 1\n1 0 1 0 0 1\n7 3 0 1 2\n"
                                       "8 4 0 1 3 2\n9 3 1 2 3\n"},
        {FileFormat::Stl,
         "solid facet a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
         "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 -0\nvertex 1 1 0\n\n"
         "vertex 0 1 0\nendloop\nendfacet\nendsolid a\nsolid b\nendsolid\nsolid c\n FACET normal 0 0 1\n"
         "outer loop\nvertex -0 -0 0\nvertex 1 0 0\nvertex 5 5 5\nendloop\nendfacet\nendsolid c\n"},
    };
}

/// Each with a fault in the middle of `good_files`, or somewhere else.
std::vector<File> bad_files()
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string off = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n";
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                              "endfacet\n";
    return {
        {FileFormat::Obj, vertices + "f 1 2 9\nv 1 1 x\nf 1 1 2\nv 4 4 4\nf 1 2 7\nf 1 2 3\n"},
        {FileFormat::Obj, vertices + "f 1 2 0\nf -9 1 2\nf 1 2\nf 3 2 1\nf 4 2 1\nf 5 2 1\n"},
        {FileFormat::Obj, vertices + "f 2147483648 1 2\nf 1 2 3\n"},
        {FileFormat::Obj, "# none\nf 1 2 3\ng a\ng b\n"},
        {FileFormat::Off, off + "1 1 0\n3 0 1 2\n3 0 1 4\n3 1 1 2\n"},
        {FileFormat::Off, off + "1 1 0\n3 0 1 2\n3 0 1 3\n"},
        {FileFormat::Off, off + "1 1 0\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 3 2 1\n"},
        {FileFormat::Ply, ply_header + "2 1 2\n1 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 0 nan 0 0 1\n1 0 1 0 0 1\n7 3 0 1 2\n"},
        {FileFormat::Ply, ply_header + "2 1 2\n1 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 0 0 0 0 1\n1 0 1 0 0 1\n7 3 0 1 9\n"
                                       "7 3 0 1 1\n7 3 0 1 2\n7 3 0 1 2\n"},
        {FileFormat::Stl, "solid a\n" + facet + facet + "endsolid\n" + facet + "endsolid\n"},
        {FileFormat::Stl, "solid a\n" + facet + facet + "endsolid\nsolid b\n" + facet},
        {FileFormat::Stl, "solid a\n" + facet + test::with(facet, "1 0 0", "0 0 0") + facet + "endsolid\n"},
        {FileFormat::Stl, "solid a\nendsolid a\nsolid b\nendsolid b\n"},
    };
}

std::string written(const PolygonMesh& mesh, const FileKind& kind)
{
    const TemporaryDirectory folder;
    write_mesh(folder / "a", mesh, kind);
    return content_of(folder / "a");
}

/// Of a few triangles and polygons.
PolygonMesh any_mesh(std::uint32_t seed, bool triangles)
{
    RandomNumbers random(seed);
    PolygonMesh mesh = test::random_mesh(random).mesh;
    if (!triangles)
        return mesh;
    PolygonMesh result;
    result.vertices = Points::Random(mesh.n_vertices(), 3);
    for (Index v = 0; v + 2 < mesh.n_vertices(); ++v)
        result.add_face(std::array{v, v + 1, v + 2});
    return result;
}

constexpr std::array binary_kinds{
    FileKind{FileFormat::Ply, Encoding::BinaryLittleEndian}, FileKind{FileFormat::Ply, Encoding::BinaryBigEndian},
    FileKind{FileFormat::Stl, Encoding::BinaryLittleEndian}, FileKind{FileFormat::Glb, Encoding::BinaryLittleEndian}};

std::string binary_off(const PolygonMesh& mesh)
{
    OutputBuffer file;
    file.text("OFF BINARY\n");
    for (const Index n : {mesh.n_vertices(), mesh.n_faces(), 0})
        file.binary(n, std::endian::big);
    for (const double x : mesh.vertices.reshaped<Eigen::RowMajor>())
        file.binary(static_cast<float>(x), std::endian::big);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        file.binary(static_cast<Index>(mesh.face(f).size()), std::endian::big);
        file.binary(mesh.face(f), std::endian::big);
        file.binary(std::uint32_t{0}, std::endian::big);
    }
    return std::string(file.content());
}

std::vector<File> binary_files(std::uint32_t seed)
{
    std::vector<File> files{{FileFormat::Off, binary_off(any_mesh(seed, false))}};
    for (const FileKind& kind : binary_kinds)
        files.push_back({kind.format, written(any_mesh(seed, !traits_of(kind.format).holds_polygons), kind)});
    return files;
}

}  // namespace

TEST_CASE("good and bad texts, cut anywhere, are read as in one go, with the same complaints")
{
    for (const auto& files : {good_files(), bad_files()})
        for (const auto& [format, content] : files)
            for (std::size_t bytes = 0; bytes < content.size(); ++bytes) {
                check_reading(format, content, bytes);
                if (format == FileFormat::Obj)
                    CHECK(extras_of_obj("a", content, {run_backwards, bytes}) == extras_of_obj("a", content));
            }
    for (const auto& [format, content] : good_files())
        CHECK(outcome_of(format, content, {run_backwards, 1}, false).messages.empty());
    for (const auto& [format, content] : bad_files())
        CHECK_FALSE(outcome_of(format, content, {run_backwards, 1}, false).messages.empty());
}

TEST_CASE("binary files, cut anywhere, are read as in one go; cut off and damaged ones, too")
{
    for (std::uint32_t seed = 1; seed <= 10; ++seed)
        for (const auto& [format, content] : binary_files(seed)) {
            RandomNumbers random(seed);
            for (const std::size_t bytes : {1, 13, 100, 1000}) {
                check_reading(format, content, bytes);
                check_reading(format, content.substr(0, content.size() - 1), bytes);
                for (int i = 0; i < 20; ++i) {
                    std::string damaged = content;
                    const auto place = static_cast<std::size_t>(random.below(static_cast<int>(content.size())));
                    damaged[place] ^= static_cast<char>(1 + random.below(255));
                    // A whole number of eight bytes that is not finite.
                    if (i % 2 > 0)
                        damaged.replace(place, 16, 16, '\xff');
                    check_reading(format, damaged, bytes);
                }
            }
        }
}

TEST_CASE("files without an element, and with padding or more after none, are read and written as in one go")
{
    const std::string header = "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    for (const std::string more : {"", "\n", "0 0 0\n", "a longer rest"})
        for (const std::string kind : {"ascii", "binary_little_endian", "binary_big_endian"}) {
            const std::string content = "ply\nformat " + kind + " 1.0\n" + header + more;
            check_reading(FileFormat::Ply, content, 7);
            CHECK(rewritten(FileFormat::Ply, content, PolygonMesh(), {run_backwards, 7}).content == content);
        }
    check_reading(FileFormat::Off, "OFF BINARY\n" + std::string(12 + 100, '\0'), 7);
}

TEST_CASE("a file without faults is read slice by slice to its end, and not again in one go")
{
    PolygonMesh mesh;
    mesh.vertices = Points::Random(500, 3);
    for (Index v = 0; v + 2 < mesh.n_vertices(); ++v)
        mesh.add_face(std::array{v, v + 1, v + 2});
    std::vector<File> files{{FileFormat::Off, binary_off(mesh)}};
    for (const FileFormat format : {FileFormat::Obj, FileFormat::Off, FileFormat::Ply, FileFormat::Stl})
        files.push_back({format, written(mesh, {format, Encoding::Ascii})});
    for (const FileKind& kind : binary_kinds)
        files.push_back({kind.format, written(mesh, kind)});
    for (const File& file : files) {
        CAPTURE(file.content.substr(0, 100));
        int n_loops = 0;
        const Executor counting = [&](Index n, const RangeBody& body) {
            run_serially(n, body);
            ++n_loops;
        };
        read(file.format, file.content, {counting, 1}, nullptr);
        constexpr int slices_at_once = 64;
        CHECK(n_loops > mesh.n_faces() / slices_at_once);
    }
}

TEST_CASE("files cut anywhere are written again as in one go")
{
    for (auto files : {good_files(), binary_files(1)})
        for (const auto& [format, content] : files) {
            if (format == FileFormat::Stl)
                continue;
            PolygonMesh mesh = read(format, content, in_one_go, nullptr);
            mesh.vertices.row(1) << 0.5, 0.25, 0.125;
            const test::Rewritten whole = rewritten(format, content, mesh, in_one_go);
            CHECK(whole.content != content);
            for (const std::size_t bytes : {0, 5, 40, 100, 200}) {
                CAPTURE(bytes);
                const test::Rewritten sliced = rewritten(format, content, mesh, {run_backwards, bytes});
                CHECK(sliced.content == whole.content);
                CHECK(sliced.remarks == whole.remarks);
            }
        }
}

TEST_CASE("slices are written in order, however many, between what comes before and behind")
{
    const TemporaryDirectory folder;
    for (const Index n : {0, 1, 31, 32, 33, 64, 1000}) {
        std::string expected = "before ";
        OutputFile file(folder / "a");
        file.text(expected);
        file.slices(n, run_backwards, [](Index i, OutputBuffer& slice) {
            for (Index k = 0; k < i % 50; ++k)
                slice.line("slice", std::array{i, k});
        });
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < i % 50; ++k)
                expected += "slice " + std::to_string(i) + " " + std::to_string(k) + "\n";
        file.text(std::string(3'000'000, 'x'));
        file.text("behind");
        file.commit();
        CHECK(content_of(folder / "a") == expected + std::string(3'000'000, 'x') + "behind");
    }
}

TEST_CASE("an error while a slice is made leaves nothing behind")
{
    const TemporaryDirectory folder;
    {
        OutputFile file(folder / "a");
        CHECK_THROWS_AS(file.slices(100, run_in_parallel,
                                    [](Index i, OutputBuffer& slice) {
                                        slice.text("x");
                                        if (i == 70)
                                            throw InputError("70");
                                    }),
                        InputError);
    }
    CHECK(folder.n_files() == 0);
}

TEST_CASE("large files are read and written by all threads as by one")
{
    const TemporaryDirectory folder;
    PolygonMesh mesh;
    mesh.vertices = Points::Random(60'000, 3);
    for (Index v = 0; v + 2 < mesh.n_vertices(); ++v)
        mesh.add_face(std::array{v, v + 1, v + 2});
    constexpr std::array kinds{FileKind{FileFormat::Obj, Encoding::Ascii}, FileKind{FileFormat::Off, Encoding::Ascii},
                               FileKind{FileFormat::Ply, Encoding::Ascii},
                               FileKind{FileFormat::Ply, Encoding::BinaryLittleEndian},
                               FileKind{FileFormat::Stl, Encoding::Ascii}};
    constexpr std::array names{"a.obj", "a.off", "a.ply", "b.ply", "a.stl"};
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        write_mesh(folder / names[k], mesh, kinds[k], run_in_parallel);
        const std::string content = content_of(folder / names[k]);
        CHECK(content == written(mesh, kinds[k]));
        const MeshFile file = read_mesh(folder / names[k], run_in_parallel);
        CHECK(test::identical(file.mesh, mesh));
        CHECK(test::identical(read_mesh(folder / names[k]).mesh, mesh));
        PolygonMesh moved = mesh;
        moved.vertices *= 0.5;
        CHECK(write_mesh_like(*file.source, folder / "like", moved, run_in_parallel).empty());
        CHECK(content_of(folder / "like") == written(moved, kinds[k]));
    }
}
