#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/mesh_files.h"
#include "tests/support/random_meshes.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using test::identical;

namespace {

/// What holds any mesh.
struct Form {
    const char* name;
    FileKind kind;
};
constexpr std::array forms{Form{"mesh.obj", {FileFormat::Obj, Encoding::Ascii}},
                           Form{"mesh.off", {FileFormat::Off, Encoding::Ascii}},
                           Form{"text.ply", {FileFormat::Ply, Encoding::Ascii}},
                           Form{"little.ply", {FileFormat::Ply, Encoding::BinaryLittleEndian}},
                           Form{"big.ply", {FileFormat::Ply, Encoding::BinaryBigEndian}}};

test::RandomMesh mesh_of(std::uint32_t seed)
{
    RandomNumbers random(seed);
    return test::random_mesh(random);
}

/// Every face as triangles around its first corner, and the coordinates as their text or bytes will have them.
PolygonMesh triangulated(const PolygonMesh& mesh, bool single_precision)
{
    PolygonMesh triangles;
    triangles.vertices = mesh.vertices;
    if (single_precision)
        triangles.vertices = mesh.vertices.cast<float>().cast<double>();
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (std::size_t k = 2; k < mesh.face(f).size(); ++k)
            triangles.add_face(std::array{mesh.face(f)[0], mesh.face(f)[k - 1], mesh.face(f)[k]});
    return triangles;
}

bool has_isolated_vertices(const PolygonMesh& mesh)
{
    const std::set<Index> used(mesh.face_vertices.begin(), mesh.face_vertices.end());
    return static_cast<Index>(used.size()) != mesh.n_vertices();
}

/// Without the faces that are lines, which readers of STL pass over.
PolygonMesh without_lines(const PolygonMesh& triangles)
{
    PolygonMesh mesh;
    mesh.vertices = triangles.vertices;
    for (Index f = 0; f < triangles.n_faces(); ++f) {
        const auto face = triangles.face(f);
        bool is_line = false;
        for (std::size_t k = 0; k < 3; ++k)
            is_line |= triangles.vertices.row(face[k]) == triangles.vertices.row(face[(k + 1) % 3]);
        if (!is_line)
            mesh.add_face(face);
    }
    return mesh;
}

bool same_corners(const PolygonMesh& a, const PolygonMesh& b)
{
    if (a.face_offsets != b.face_offsets)
        return false;
    for (Index c = 0; c < a.n_corners(); ++c)
        if (a.vertices.row(a.face_vertices[c]) != b.vertices.row(b.face_vertices[c]))
            return false;
    return true;
}

/// Calls `check` with every random mesh and every form that holds it.
template <class Check>
void for_random_files(std::uint32_t n_meshes, const Check& check)
{
    for (std::uint32_t seed = 1; seed <= n_meshes; ++seed) {
        const test::RandomMesh random = mesh_of(seed);
        CAPTURE(seed);
        CAPTURE(random.description);
        for (const Form& form : forms) {
            CAPTURE(form.name);
            check(random.mesh, form);
        }
    }
}

}  // namespace

TEST_CASE("random meshes come back from every kind of file, to the bit")
{
    for_random_files(200, [](const PolygonMesh& mesh, const Form& form) {
        const MeshFile read = test::round_trip(mesh, form.name, form.kind);
        CHECK(read.kind == form.kind);
        CHECK(identical(read.mesh, mesh));
    });
}

TEST_CASE("random meshes that are moved come back from files in the form of those they were read from")
{
    for_random_files(100, [](const PolygonMesh& mesh, const Form& form) {
        const test::TemporaryDirectory folder;
        write_mesh(folder / form.name, mesh, form.kind);
        const MeshFile read = read_mesh(folder / form.name);
        PolygonMesh moved = read.mesh;
        moved.vertices = 0.75 * moved.vertices.rowwise().reverse();
        CHECK(write_mesh_like(*read.source, folder / form.name, moved).empty());
        const MeshFile again = read_mesh(folder / form.name);
        CHECK(again.kind == form.kind);
        CHECK(identical(again.mesh, moved));
    });
}

TEST_CASE("random triangles come back from STL files with the same corners, or are refused for a reason")
{
    int n_written = 0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed)
        for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian}) {
            const PolygonMesh triangles = triangulated(mesh_of(seed).mesh, encoding != Encoding::Ascii);
            CAPTURE(seed);
            const FileKind kind{FileFormat::Stl, encoding};
            if (has_isolated_vertices(triangles)) {
                CHECK_FALSE(test::complaint_of_writing(triangles, "mesh.stl", kind).empty());
                continue;
            }
            const PolygonMesh expected = without_lines(triangles);
            const auto n_lines = triangles.n_faces() - expected.n_faces();
            if (expected.n_faces() == 0)
                continue;
            ++n_written;
            const test::TemporaryDirectory folder;
            CHECK(static_cast<Index>(write_mesh(folder / "mesh.stl", triangles, kind).size()) ==
                  std::min(n_lines, Index{1}));
            FaultLog faults{.of_faces_alone = true};
            const MeshFile read = read_faulty_mesh(folder / "mesh.stl", faults);
            CHECK(read.kind == kind);
            CHECK(same_corners(read.mesh, expected));
            CHECK(static_cast<Index>(faults.faces_left_out.size()) == n_lines);
        }
    CHECK(n_written > 150);
}
