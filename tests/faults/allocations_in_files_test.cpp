// Reading, cutting and writing with every single allocation failing.

#include <fmt/format.h>

#include "engine/state/checkpoint.h"
#include "engine/state/flow_state.h"
#include "partition/cut/cut_into.h"
#include "partition/formats/index_files.h"
#include "partition/formats/mesh_io.h"
#include "partition/topology.h"
#include "tests/faults/every_allocation.h"
#include "tests/faults/small_runs.h"
#include "tests/support/gltf_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using test::fail_every_allocation;
namespace fs = std::filesystem;

namespace {

template <class Array>
std::string bytes_of(const Array& array)
{
    return {reinterpret_cast<const char*>(array.data()),
            static_cast<std::size_t>(array.size()) * sizeof(*array.data())};
}

std::string bytes_of_mesh(const PolygonMesh& mesh)
{
    return bytes_of(mesh.vertices) + bytes_of(mesh.face_offsets) + bytes_of(mesh.face_vertices);
}

/// A tetrahedron with all that a file may have besides.
const std::string obj = "mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\ng one\n"
                        "f 1/1/1 3/1/1 2/1/1\nusemtl red\nf 1//1 2//1 4//1\nf 2 3 4\ns 1\nf -4 -1 -2\n# end\n";
const std::string off = "NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n"
                        "3 0 2 1 9 9 9\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string ply = "ply\nformat ascii 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty float y\n"
                        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 4\n"
                        "property list uchar int vertex_indices\nproperty int label\nend_header\n0 0 0 0 0 1\n"
                        "1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n3 0 2 1 5\n3 0 1 3 5\n3 1 2 3 5\n3 0 3 2 5\n";
const std::string stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                        "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
                        "endfacet\nendsolid a\n";

/// The square twice: with normals between its positions, and with sparse positions.
test::GltfMaker gltf()
{
    test::GltfMaker maker;
    const int corners = maker.indices(std::vector<unsigned short>{0, 1, 2, 0, 2, 3});
    const int view = maker.view(
        test::bytes_of(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}),
        R"("byteStride":24)");
    const int positions = maker.accessor(view, 5126, 4, "VEC3", R"("min":[0,0,0],"max":[1,1,0])");
    const int normals = maker.accessor(view, 5126, 4, "VEC3", R"("byteOffset":12)");
    const int sparse = maker.accessor(-1, 5126, 4, "VEC3",
                                      maker.sparse(std::vector<unsigned char>{1, 2, 3}, {2, 0, 0, 2, 2, 0, 0, 2, 0}));
    maker.mesh({fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{}}},"indices":{},"targets":[{{}}]}})",
                            positions, normals, corners),
                fmt::format(R"({{"attributes":{{"POSITION":{}}},"mode":6}})", sparse)});
    maker.more = R"("materials":[{}])";
    return maker;
}

/// Files of every format and encoding.
std::vector<fs::path> mesh_files(const test::TemporaryDirectory& directory)
{
    std::vector<fs::path> files{directory.with("a.glb", gltf().glb()), directory.with("a.gltf", gltf().text("a.bin")),
                                directory.with("a.obj", obj),          directory.with("a.off", off),
                                directory.with("a.ply", ply),          directory.with("a.stl", stl)};
    static_cast<void>(directory.with("a.bin", gltf().bytes()));
    const PolygonMesh mesh = read_mesh(files.back()).mesh;
    const auto add = [&](const char* name, FileKind kind) {
        files.push_back(directory / name);
        write_mesh(files.back(), mesh, kind);
    };
    add("big.ply", {.format = FileFormat::Ply, .encoding = Encoding::BinaryBigEndian});
    add("little.ply", {.format = FileFormat::Ply, .encoding = Encoding::BinaryLittleEndian});
    add("binary.stl", {.format = FileFormat::Stl, .encoding = Encoding::BinaryLittleEndian});
    return files;
}

}  // namespace

TEST_CASE("reading a file of any format")
{
    const test::TemporaryDirectory directory;
    for (const fs::path& path : mesh_files(directory)) {
        CAPTURE(path.filename());
        PolygonMesh mesh;
        fail_every_allocation(
            {.run = [&] { mesh = read_mesh(path).mesh; }, .result = [&] { return bytes_of_mesh(mesh); }});
    }
}

TEST_CASE("reading a file with faults")
{
    const test::TemporaryDirectory directory;
    const auto path = directory.with("a.obj", obj + "f 1 2 2\nf 1 2 9\n");
    PolygonMesh mesh;
    fail_every_allocation({.run =
                               [&] {
                                   FaultLog faults;
                                   mesh = read_faulty_mesh(path, faults).mesh;
                               },
                           .result = [&] { return bytes_of_mesh(mesh); }});
}

TEST_CASE("reading labels and vertices that are held")
{
    const test::TemporaryDirectory directory;
    const auto labels_file = directory.with("labels", "0\n1\n0\n1\n");
    const auto held_file = directory.with("held", "0\n2\n");
    std::vector<Index> labels;
    std::vector<Index> held;
    fail_every_allocation({.run =
                               [&] {
                                   labels = read_labels(labels_file, 4);
                                   held = read_vertex_set(held_file, 4, {});
                               },
                           .result = [&] { return bytes_of(labels) + bytes_of(held); }});
}

TEST_CASE("writing a file of any format, as itself and anew: it is whole, or as it was before")
{
    const test::TemporaryDirectory directory;
    for (const fs::path& path : mesh_files(directory)) {
        CAPTURE(path.filename());
        const MeshFile file = read_mesh(path);
        PolygonMesh mesh = file.mesh;
        mesh.vertices *= 2.0;
        const test::TemporaryDirectory results;
        const auto target = results.with("out" + path.extension().string(), "old");
        const auto expected = [&, n = results.n_files()] {
            CHECK(results.n_files() == n);
            CHECK(test::content_of(target) == "old");
        };
        const auto begin_anew = [&] {
            for (const auto& old : fs::directory_iterator(results.path()))
                fs::remove(old);
            static_cast<void>(results.with(target.filename(), "old"));
        };
        for (const bool as_itself : {true, false}) {
            CAPTURE(as_itself);
            fail_every_allocation({.run =
                                       [&] {
                                           if (as_itself)
                                               write_mesh_like(*file.source, target, mesh);
                                           else
                                               write_mesh(target, mesh, file.kind);
                                       },
                                   .result =
                                       [&] {
                                           const std::string content =
                                               test::content_of(target) + test::content_of(results / "out.bin");
                                           begin_anew();
                                           return content;
                                       },
                                   .check_failed = expected});
        }
    }
}

TEST_CASE("cutting, with METIS, and as labels say")
{
    const PolygonMesh mesh = test::small_mesh();
    const Topology topology = make_topology(mesh);
    const auto labels = test::random_labels(mesh.n_faces(), 3, 1);
    Cut cut;
    for (const Index k : {0, 2, 3})
        fail_every_allocation(
            {.run = [&] { cut = k > 0 ? cut_into(mesh, topology, k) : cut_by_labels(mesh, topology, labels); },
             .result = [&] { return bytes_of(cut.labels); }});
}

TEST_CASE("a checkpoint, written and read")
{
    const test::TemporaryDirectory directory;
    FlowState state;
    FlowOptions options = test::small_flows(1, 1).front().options;
    PolygonMesh mesh = test::small_mesh();
    mean_curvature_flow(mesh, options, [&](const StepState& now) { state = *now.capture(); });
    const auto target = directory / "state";
    const auto content = [&] { return test::content_of(target); };
    fail_every_allocation({.run = [&] { write_checkpoint(target, state); }, .result = content});
    FlowState read;
    fail_every_allocation(
        {.run = [&] { read = *read_checkpoint(target); }, .result = [&] { return bytes_of(read.positions()); }});
    CHECK(directory.n_files() == 1);
}
