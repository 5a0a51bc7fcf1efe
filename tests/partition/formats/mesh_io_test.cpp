#include <array>
#include <clocale>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Variant {
    const char* name;
    FileKind kind;
    bool triangles_only;
    bool single_precision;
};

constexpr std::array<Variant, 9> variants = {{
    {"a.obj", {FileFormat::Obj, Encoding::Ascii}, false, false},
    {"a.off", {FileFormat::Off, Encoding::Ascii}, false, false},
    {"a.ply", {FileFormat::Ply, Encoding::Ascii}, false, false},
    {"a.ply", {FileFormat::Ply, Encoding::BinaryLittleEndian}, false, false},
    {"a.ply", {FileFormat::Ply, Encoding::BinaryBigEndian}, false, false},
    {"a.stl", {FileFormat::Stl, Encoding::Ascii}, true, false},
    {"a.stl", {FileFormat::Stl, Encoding::BinaryLittleEndian}, true, true},
    {"a.glb", {FileFormat::Glb, Encoding::BinaryLittleEndian}, true, true},
    {"a.gltf", {FileFormat::Gltf, Encoding::BinaryLittleEndian}, true, true},
}};

std::string message_of_reading(const std::filesystem::path& path)
{
    return message_of<InputError>([&] { read_mesh(path); });
}

std::string message_of_writing(const std::filesystem::path& path)
{
    return message_of<OutputError>([&] { write_mesh(path, make_triangle(), {FileFormat::Obj, Encoding::Ascii}); });
}

}  // namespace

TEST_CASE("Every variant keeps every bit of the coordinates, whatever the locale's decimal point")
{
    for (const char* locale : {"C", "de_DE.UTF-8", "fr_FR.UTF-8"}) {
        std::setlocale(LC_NUMERIC, locale);
        for (const Variant& variant : variants) {
            const auto mesh = make_mesh(tricky_points(variant.single_precision), {{0, 1, 2}, {3, 4, 5}});
            const auto file = round_trip(mesh, variant.name, variant.kind);
            CHECK(file.kind == variant.kind);
            CHECK(identical(file.mesh, mesh));
        }
    }
    std::setlocale(LC_NUMERIC, "C");
}

TEST_CASE("Text uses at most 17 digits")
{
    const TemporaryDirectory folder;
    const auto path = folder.path() / "a.obj";
    auto mesh = make_triangle();
    mesh.vertices.row(0) << 123456789012345680000.0, -1e17, 99999999999999984.0;
    write_mesh(path, mesh, {FileFormat::Obj, Encoding::Ascii});
    CHECK(content_of(path).starts_with("v 1.2345678901234568e+20 -1e+17 99999999999999984\n"));
}

TEST_CASE("Faces of 300 sides, and vertices without faces")
{
    std::vector<Index> face(300);
    std::iota(face.begin(), face.end(), 1);
    PolygonMesh mesh;
    mesh.vertices = Points::Random(302, 3);
    mesh.add_face(face);
    mesh.add_face(std::span(face).first(5));
    for (const Variant& variant : variants)
        if (!variant.triangles_only)
            CHECK(identical(round_trip(mesh, variant.name, variant.kind).mesh, mesh));
    const TemporaryDirectory folder;
    write_labelled_ply(folder.path() / "a.ply", mesh, std::vector<Index>{0, 1});
    CHECK(identical(read_mesh(folder.path() / "a.ply").mesh, mesh));
    CHECK(contains(content_of(folder.path() / "a.ply"), "property list int int vertex_indices"));
}

TEST_CASE("A mesh without faces")
{
    const auto mesh = make_mesh(tricky_points(false), {});
    for (const Variant& variant : variants)
        if (!variant.triangles_only)
            CHECK(identical(round_trip(mesh, variant.name, variant.kind).mesh, mesh));
}

TEST_CASE("Every file cut off anywhere is refused or read, and refused by the binary formats")
{
    for (const Variant& variant : variants) {
        const TemporaryDirectory folder;
        const auto path = folder.path() / variant.name;
        write_mesh(path, make_mesh(tricky_points(variant.single_precision), {{0, 1, 2}, {3, 4, 5}}), variant.kind);
        const std::string whole = content_of(path);
        for (std::size_t n = 0; n < whole.size(); ++n) {
            const bool refused = !complaint_about(variant.name, std::string_view(whole).substr(0, n)).empty();
            CHECK((refused || variant.kind.encoding == Encoding::Ascii));
        }
    }
}

TEST_CASE("Files that cannot be opened")
{
    const TemporaryDirectory folder;
    const auto missing = folder.path() / "missing.obj";
    CHECK(message_of_reading(missing) == missing.string() +
                                             ": cannot be read: No such file or directory; check the name and the "
                                             "permissions of the file");
    std::filesystem::create_directory(folder.path() / "folder.obj");
    CHECK(contains(message_of_reading(folder.path() / "folder.obj"), "cannot be read: Is a directory"));
    CHECK(contains(complaint_about("empty.obj", ""), "empty.obj: the file is empty"));
    CHECK(contains(complaint_about("a.xyz", "v 0 0 0\n"),
                   "a.xyz: the extension '.xyz' is not one of .obj, .off, .ply, .stl, .glb or .gltf"));
    CHECK(contains(complaint_about("a", "v 0 0 0\n"), "the extension '' is not one of"));
}

TEST_CASE("The extension may be in upper case")
{
    CHECK(read_text("A.OBJ", "v 0 0 0\n").kind.format == FileFormat::Obj);
    CHECK(format_of("a.GlTf") == FileFormat::Gltf);
    CHECK(read_text("a.OfF", "OFF 1 0 0\n0 0 0\n").kind.format == FileFormat::Off);
}

TEST_CASE("Content that cannot be read in the format of the extension, but in another, is refused with the right one")
{
    const TemporaryDirectory folder;
    const auto is_gltf = [](FileFormat format) { return format == FileFormat::Glb || format == FileFormat::Gltf; };
    for (const Variant& variant : variants) {
        const auto right = folder.path() / variant.name;
        write_mesh(right, make_triangle(), variant.kind);
        for (const FormatTraits& other : format_traits) {
            if (other.format == variant.kind.format)
                continue;
            CAPTURE(std::string(variant.name));
            CAPTURE(std::string(other.extension));
            const auto misnamed = folder.path() / ("misnamed" + std::string(other.extension));
            std::filesystem::copy_file(right, misnamed, std::filesystem::copy_options::overwrite_existing);
            if (is_gltf(variant.kind.format) && is_gltf(other.format)) {
                CHECK(read_mesh(misnamed).mesh.n_faces() == 1);
                continue;
            }
            const std::string message = message_of_reading(misnamed);
            // OBJ has no signature: readers say what they miss.
            if (variant.kind.format != FileFormat::Obj)
                CHECK(message == misnamed.string() + ": this is no " + std::string(other.name) +
                                     " file, but has the format " + std::string(traits_of(variant.kind.format).name) +
                                     "; give it the extension " + extension_of(variant.kind.format));
            else
                CHECK_FALSE(message.empty());
        }
    }
    // What can be read is, whatever words it begins with: the header of a binary STL, and the lines of an OBJ.
    const auto stl = folder.path() / "a.stl";
    write_mesh(stl, make_triangle(), {FileFormat::Stl, Encoding::BinaryLittleEndian});
    for (const std::string words : {"ply\n", "{ }\n", "OFF\n", "glTF", "solid\n"}) {
        std::string content = content_of(stl);
        content.replace(0, words.size(), words);
        CHECK(read_mesh(folder.with("a.stl", content)).mesh.n_faces() == 1);
        CHECK(read_mesh(folder.with("a.obj", words + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).mesh.n_faces() == 1);
    }
}

TEST_CASE("The kind of an output follows its extension, and its source where the format is the same")
{
    const FileKind obj{FileFormat::Obj, Encoding::Ascii};
    const FileKind off{FileFormat::Off, Encoding::Ascii};
    const FileKind binary_stl{FileFormat::Stl, Encoding::BinaryLittleEndian};
    for (const auto encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian}) {
        const FileKind ply{FileFormat::Ply, encoding};
        CHECK(kind_for_writing("b.PLY", ply) == ply);
        CHECK(kind_for_writing("b.obj", ply) == obj);
        CHECK(kind_for_writing("b.off", ply) == off);
        CHECK(kind_for_writing("b.stl", ply) == binary_stl);
    }
    CHECK(kind_for_writing("b.stl", {FileFormat::Stl, Encoding::Ascii}) == FileKind{FileFormat::Stl, Encoding::Ascii});
    CHECK(kind_for_writing("b.ply", obj) == FileKind{FileFormat::Ply, Encoding::BinaryLittleEndian});
    CHECK_THROWS_WITH_AS(kind_for_writing("b.vtk", obj),
                         "b.vtk: the extension '.vtk' is not one of .obj, .off, .ply, .stl, .glb or .gltf; give the "
                         "file the extension of "
                         "its format",
                         OptionError);
}

TEST_CASE("The formats are named by their extensions")
{
    CHECK(extensions_of() == ".obj, .off, .ply, .stl, .glb or .gltf");
    CHECK(extensions_of(FormatGroup::Polygons) == ".obj, .off or .ply");
    CHECK(extensions_of(FormatGroup::Text) == ".obj or .off");
    CHECK(format_of("a.PlY") == FileFormat::Ply);
    CHECK_FALSE(format_of("ply"));
}

TEST_CASE("Encodings that a format does not have")
{
    const TemporaryDirectory folder;
    const auto write = [&](FileKind kind) { write_mesh(folder.path() / "a", make_triangle(), kind); };
    CHECK_THROWS_AS(write({FileFormat::Obj, Encoding::BinaryLittleEndian}), OptionError);
    CHECK_THROWS_AS(write({FileFormat::Off, Encoding::BinaryBigEndian}), OptionError);
    CHECK_THROWS_WITH_AS(write({FileFormat::Stl, Encoding::BinaryBigEndian}),
                         "encoding must be Ascii or BinaryLittleEndian for STL files", OptionError);
    CHECK(folder.n_files() == 0);
}

TEST_CASE("A mesh that could not be read again is not written")
{
    for (const Variant& variant : variants) {
        CHECK(contains(complaint_of_writing({}, variant.name, variant.kind), "the mesh has no vertices"));
        auto mesh = make_triangle();
        mesh.vertices(2, 1) = std::numeric_limits<double>::quiet_NaN();
        CHECK(contains(complaint_of_writing(mesh, variant.name, variant.kind), "vertex 2 (numbered from 0)"));
        mesh = make_triangle();
        mesh.face_vertices[1] = 3;
        CHECK(contains(complaint_of_writing(mesh, variant.name, variant.kind), "face 0 (numbered from 0)"));
    }
}

TEST_CASE("PLY: faces of as many corners as a byte can count, and of one more")
{
    const TemporaryDirectory folder;
    for (const Index n : {255, 256, 257})
        for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian}) {
            std::vector<Index> corners(n);
            std::iota(corners.begin(), corners.end(), 0);
            PolygonMesh mesh;
            mesh.vertices.setZero(n, 3);
            mesh.vertices.col(0).setLinSpaced(0.0, 1.0);
            mesh.add_face(corners);
            write_mesh(folder.path() / "a.ply", mesh, {FileFormat::Ply, encoding});
            CHECK(identical(read_mesh(folder.path() / "a.ply").mesh, mesh));
        }
}

TEST_CASE("Places where nothing can be written")
{
    const TemporaryDirectory folder;
    const auto nowhere = folder.path() / "nowhere" / "a.obj";
    CHECK(message_of_writing(nowhere) == nowhere.string() +
                                             ": cannot be written: No such file or directory; check that the folder "
                                             "exists, that you may write there, and that there is room left");
    std::filesystem::create_directory(folder.path() / "a.obj");
    CHECK(contains(message_of_writing(folder.path() / "a.obj"), "cannot be written: Is a directory"));
    CHECK(contains(message_of_writing("/dev/null"), "/dev/null: is not a regular file"));
    CHECK(folder.n_files() == 1);
}
