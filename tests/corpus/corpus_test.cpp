#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/topology.h"
#include "partition/weld.h"
#include "tests/support/flows.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

/// The meshes below a folder, either those under nasty/ or the others, sorted.
std::vector<std::filesystem::path> meshes_below(const std::filesystem::path& folder, bool nasty = false)
{
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const bool is_mesh = format_of(entry.path()).has_value();
        if (is_mesh && (entry.path().parent_path().filename() == "nasty") == nasty)
            paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

void check_flow(const PolygonMesh& mesh, Laplacian laplacian, Index subdomains)
{
    CAPTURE(name_of(laplacian));
    CAPTURE(subdomains);
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = mean_edge_length(mesh) * mean_edge_length(mesh);
    options.cut.subdomains = subdomains;
    const Points result = test::flowed(mesh, options);
    CHECK(result.rows() == mesh.vertices.rows());
    CHECK(result.allFinite());
    const Topology topology = make_topology(mesh);
    // Along seams vertices move that are on the boundary.
    const auto joined = weld(mesh, topology, options.motion.weld->value);
    const auto moves = [&](Index v) {
        return joined ? joined->topology.moves(joined->representative[v]) : topology.kind[v] == VertexKind::Interior;
    };
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (!moves(v))
            REQUIRE(result.row(v) == mesh.vertices.row(v));
}

void check_round_trip(const MeshFile& file, const std::filesystem::path& copy)
{
    write_mesh(copy, file.mesh, file.kind);
    const MeshFile again = read_mesh(copy);
    CHECK(again.kind == file.kind);
    CHECK(again.mesh.vertices == file.mesh.vertices);
    CHECK(again.mesh.face_offsets == file.mesh.face_offsets);
    CHECK(again.mesh.face_vertices == file.mesh.face_vertices);
}

/// All files, nasty ones among them: those that cannot be read do not matter here.
void check_form(const std::filesystem::path& path, const std::filesystem::path& copy)
{
    MeshFile file;
    try {
        file = read_mesh(path);
    } catch (const InputError&) {
        return;
    }
    // Those of a .gltf file get a name of their own for the file with its buffer.
    if (file.kind.format == FileFormat::Stl || file.kind.format == FileFormat::Gltf)
        return;
    CHECK(write_mesh_like(*file.source, copy, file.mesh).empty());
    CHECK((test::content_of(copy) == test::content_of(path)));
}

}  // namespace

TEST_CASE("every OBJ, OFF, PLY and .glb file of the corpus is the same file when it is written in its own form")
{
    const char* corpus = std::getenv("SEAMFLOW_CORPUS");
    if (corpus == nullptr) {
        MESSAGE("SEAMFLOW_CORPUS is not set: no corpus to test with");
        return;
    }
    const test::TemporaryDirectory directory;
    for (const bool nasty : {false, true})
        for (const auto& path : meshes_below(corpus, nasty)) {
            CAPTURE(path.string());
            check_form(path, directory / ("copy" + path.extension().string()));
        }
}

TEST_CASE("every mesh of the corpus survives reading, writing and flowing, in one sub-mesh and in eight")
{
    const char* corpus = std::getenv("SEAMFLOW_CORPUS");
    if (corpus == nullptr) {
        MESSAGE("SEAMFLOW_CORPUS is not set: no corpus to test with");
        return;
    }
    const test::TemporaryDirectory directory;
    const auto paths = meshes_below(corpus);
    REQUIRE_FALSE(paths.empty());
    for (const auto& path : paths) {
        CAPTURE(path.string());
        const MeshFile file = read_mesh(path);
        check_round_trip(file, directory / ("copy" + path.extension().string()));
        for (const Laplacian laplacian : test::all_laplacians)
            for (const Index subdomains : {1, 8})
                check_flow(file.mesh, laplacian, subdomains);
    }
}
