// Compressed meshes: what is packed comes back, and what is no whole gzip file is refused.

#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/io/gzip.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using test::contains;
using test::content_of;

namespace {

std::string packed(const std::vector<std::string>& pieces)
{
    GzipMember member;
    std::string bytes(GzipMember::head());
    for (const std::string& text : pieces) {
        const PackedPiece piece = pack_piece(text);
        member.add(piece);
        bytes += piece.bytes;
    }
    return bytes + member.tail();
}

std::string unpacked(std::string_view bytes)
{
    std::string text;
    unpack_gzip("a.gz", bytes, [&](std::string_view piece) { text += piece; });
    return text;
}

std::string complaint_about(std::string_view bytes)
{
    return test::message_of<InputError>([&] { unpacked(bytes); });
}

/// Large enough for several slices.
PolygonMesh large_mesh()
{
    PolygonMesh mesh;
    mesh.vertices = Points::Random(30'000, 3);
    for (Index v = 0; v + 2 < mesh.n_vertices(); ++v)
        mesh.add_face(std::vector<Index>{v, v + 1, v + 2});
    return mesh;
}

}  // namespace

TEST_CASE("what is packed in pieces is unpacked as one; members one behind the other are, too, and padding is none")
{
    const std::string long_text(1'000'000, 'x');
    for (const auto& pieces :
         std::vector<std::vector<std::string>>{{}, {""}, {"a"}, {"a", "", "bc"}, {long_text, "end", long_text}}) {
        std::string all;
        for (const std::string& piece : pieces)
            all += piece;
        CHECK(is_gzip(packed(pieces)));
        CHECK(unpacked(packed(pieces)) == all);
        CHECK(unpacked(packed(pieces) + packed({"more"}) + std::string(100, '\0')) == all + "more");
    }
}

TEST_CASE("a compressed file that is cut off, damaged or followed by something else is refused")
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string whole = packed({text, text});
    for (std::size_t n = 2; n < whole.size(); ++n)
        CHECK(contains(complaint_about(whole.substr(0, n)), "a.gz: the compressed data end too early"));
    constexpr std::size_t head = 10;
    for (std::size_t i = head; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] ^= '\x10';
        CHECK((!complaint_about(damaged).empty() || unpacked(damaged) == text + text));
    }
    std::string damaged = whole;
    damaged[whole.size() - 5] ^= '\x10';
    CHECK(contains(complaint_about(damaged), "a.gz: the compressed data are damaged"));
    CHECK(contains(complaint_about(whole + "more"), "a.gz: something else follows the compressed data"));
}

TEST_CASE("a compressed file that grows beyond what is plausible is refused before it has")
{
    const std::string zeros(std::size_t{1} << 24, '\0');
    std::size_t n_unpacked = 0;
    const auto count = [&](std::string_view piece) { n_unpacked += piece.size(); };
    unpack_gzip("a.gz", packed({zeros, zeros, zeros}), count);
    CHECK(n_unpacked == 3 * zeros.size());
    n_unpacked = 0;
    const std::string bomb = packed(std::vector<std::string>(20, zeros));
    CHECK_THROWS_WITH_AS(unpack_gzip("a.gz", bomb, count),
                         doctest::Contains("times their size, as no mesh does; if they are one, unpack them"),
                         InputError);
    CHECK(n_unpacked <= 250 * bomb.size() + (std::size_t{1} << 26));
}

TEST_CASE("compressed meshes of every format are read and written, anew and like what was read")
{
    const test::TemporaryDirectory folder;
    const PolygonMesh mesh = large_mesh();
    PolygonMesh moved = mesh;
    moved.vertices *= 0.5;
    for (const std::string extension : {".obj", ".off", ".ply", ".STL"}) {
        const auto plain = folder / ("a" + extension);
        const auto compressed = folder / ("a" + extension + ".gz");
        const FileKind kind{*format_of(compressed), Encoding::Ascii};
        write_mesh(plain, mesh, kind);
        for (const Executor& exec : {Executor(run_serially), Executor(run_in_parallel)}) {
            write_mesh(compressed, mesh, kind, exec);
            CHECK(unpacked(content_of(compressed)) == content_of(plain));
        }
        const MeshFile file = read_mesh(compressed, run_in_parallel);
        CHECK(file.kind == kind);
        CHECK(test::identical(file.mesh, mesh));
        write_mesh_like(*file.source, folder / "like", moved);
        write_mesh_like(*file.source, folder / "like.GZ", moved, run_in_parallel);
        CHECK(unpacked(content_of(folder / "like.GZ")) == content_of(folder / "like"));
    }
}

TEST_CASE("what is compressed is recognised by its content, and an empty one is refused")
{
    CHECK(test::read_text("a.obj", packed({"v 0 0 0\n"})).mesh.n_vertices() == 1);
    CHECK(test::read_text("a.obj.gz", "v 0 0 0\n").mesh.n_vertices() == 1);
    CHECK(contains(test::complaint_about("a.obj.gz", packed({})), "a.obj.gz: there is nothing in it"));
    CHECK(contains(test::complaint_about("a.obj.gz", packed({"v 0 0\n"})), "a.obj.gz:1: expected coordinate z"));
    CHECK(contains(test::complaint_about("a.gz", packed({"v 0 0 0\n"})), "the extension '.gz' is not one of"));
}

TEST_CASE("extensions with and without .gz")
{
    CHECK(before_extension("a//b.c.obj") == "a//b.c");
    CHECK(before_extension("a//b.c.obj.gz") == "a//b.c");
    CHECK(before_extension("b") == "b");
    CHECK(format_of("a.PLY.Gz") == FileFormat::Ply);
    CHECK_FALSE(format_of("a.gz"));
    CHECK(extension_of(FileFormat::Off) == ".off");
}
