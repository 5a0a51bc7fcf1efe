// Any bytes as a mesh file of the format SEAMFLOW_FUZZED_EXTENSION: they are refused with an InputError, or read as a
// mesh that is valid, and that comes back as it was from the files that are written of it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"
#include "partition/formats/stl.h"
#include "partition/inspection/mesh_inspection.h"
#include "partition/io/input_file.h"
#include "partition/topology.h"
#include "tests/fuzz/fuzzed_file.h"

namespace {

using namespace seamflow;
using namespace seamflow::test;

const std::string extension = SEAMFLOW_FUZZED_EXTENSION;

/// Reads the file as far as possible and examines what there is.
/// @returns how many faults it has; nothing if it is no mesh.
std::optional<std::uint64_t> faults_of(const FuzzedFile& file)
{
    try {
        FaultLog faults;
        const MeshFile read = read_faulty_mesh(file.path(), faults);
        const MeshInspection inspection = inspect(read.mesh, make_topology(read.mesh));
        demand(faults.count > 0 || inspection.defects.vertices_not_finite.empty(),
               "a coordinate that is not finite is a fault");
        return faults.count;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// @param relative by how much coordinates may differ.
bool same_surface(const PolygonMesh& a, const PolygonMesh& b, double relative)
{
    if (a.face_offsets != b.face_offsets || a.face_vertices != b.face_vertices || a.n_vertices() != b.n_vertices())
        return false;
    for (Eigen::Index i = 0; i < a.vertices.size(); ++i) {
        const double x = a.vertices.data()[i];
        const double y = b.vertices.data()[i];
        // The second bound: floats near zero are further apart.
        if (!(std::abs(x - y) <= std::max(relative * std::abs(x), relative > 0.0 ? 1e-44 : 0.0)))
            return false;
    }
    return true;
}

void demand_same(const FuzzedFile& file, const std::string& name, const PolygonMesh& mesh, double relative)
{
    const MeshFile again = read_mesh(file.beside(name));
    demand(same_surface(mesh, again.mesh, relative), "the mesh comes back from " + name + " as it was");
}

/// Writes a mesh if the format can hold it.
template <class Write>
bool is_written(Write&& write)
{
    try {
        write();
        return true;
    } catch (const OutputError&) {
        return false;
    }
}

/// Reads the colours, if the file has any, and writes them again.
void write_colours_again(const FuzzedFile& file, const MeshFile& read)
{
    FileFields colours;
    try {
        const std::vector<std::string> names = {"colour"};
        colours = read_fields(*read.source, names);
    } catch (const InputError&) {
        return;
    }
    const std::string same = "same" + extension;
    write_mesh_like(*read.source, file.beside(same), read.mesh);
    const std::string coloured = "coloured" + extension;
    std::vector<std::string> remarks;
    const auto write = [&] { remarks = write_mesh_like(*read.source, file.beside(coloured), read.mesh, colours); };
    // With a remark a type may be another one.
    if (is_written(write) && remarks.empty())
        demand(test::content_of(file.beside(coloured)) == test::content_of(file.beside(same)),
               "colours that stay change no byte");
}

void write_and_read_again(const FuzzedFile& file, const MeshFile& read)
{
    write_colours_again(file, read);
    require_valid(read.mesh);
    static_cast<void>(extras_of(*read.source));
    const bool stl = read.kind.format == FileFormat::Stl;
    // Corners of STL files are joined where they are equal: the numbers of the vertices stay only if nothing moves.
    // Binary OFF files count as text, and stay binary where they are written like what was read.
    const bool floats = read.kind.encoding != Encoding::Ascii || read.kind.format == FileFormat::Off;
    // Binary PLY files that are made anew have doubles.
    const bool is_always_single = !traits_of(read.kind.format).holds_polygons;
    PolygonMesh moved = read.mesh;
    if (!stl)
        moved.vertices *= 0.75;
    const std::string like = "like" + extension;
    if (is_written([&] { write_mesh_like(*read.source, file.beside(like), moved); }))
        demand_same(file, like, moved, floats ? 1e-7 : 0.0);
    const std::string anew = "anew" + extension;
    if (is_written([&] { write_mesh(file.beside(anew), moved, read.kind); }))
        demand_same(file, anew, moved, floats && is_always_single ? 1e-7 : 0.0);
}

/// Reads the content of a file in slices of few bytes.
PolygonMesh read_in_slices(const OpenFile& file, std::string_view content)
{
    const Slicing slicing{run_serially, 7};
    switch (*format_of("a" + extension)) {
    case FileFormat::Obj:
        return read_obj("a", content, slicing);
    case FileFormat::Off:
        return read_off("a", content, slicing);
    case FileFormat::Ply:
        return read_ply("a", content, slicing).mesh;
    case FileFormat::Glb:
    case FileFormat::Gltf:
        if (const auto all = with_gltf_buffers(file, content))
            return read_gltf("a", InputFile(*all).content(), slicing);
        return read_gltf("a", content, slicing);
    case FileFormat::Stl:
        break;
    }
    return read_stl("a", content, slicing).mesh;
}

/// The mesh in the file, read in slices; nothing if it has faults or is no mesh.
std::optional<PolygonMesh> mesh_in_slices(const FuzzedFile& file)
{
    try {
        const OpenFile open(file.path());
        return read_in_slices(open, InputFile(open).content());
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n_bytes)
{
    const FuzzedFile file("fuzzed" + extension, bytes, n_bytes);
    const auto faults = faults_of(file);
    try {
        const MeshFile read = read_mesh(file.path());
        demand(faults == 0U, "what can be read has no faults");
        const auto in_slices = mesh_in_slices(file);
        demand(in_slices && same_surface(read.mesh, *in_slices, 0.0), "slices make the same mesh");
        write_and_read_again(file, read);
    } catch (const InputError&) {
        demand(faults != 0U, "what has no faults can be read");
        demand(!mesh_in_slices(file), "what cannot be read in one go cannot be read in slices");
    }
    return 0;
}
