#include <algorithm>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/resolved_options.h"
#include "engine/surface/flowing_mesh.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Every face twice, the second time seen from the other side.
PolygonMesh doubled(const PolygonMesh& mesh)
{
    PolygonMesh both = mesh;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        std::reverse(corners.begin(), corners.end());
        both.add_face(corners);
    }
    return both;
}

FlowOptions repeated_faces_options(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.cut.subdomains = subdomains;
    options.time_step = 0.002;
    options.steps = 2;
    return options;
}

}  // namespace

TEST_CASE("a surface whose faces are there twice flows like the single one, and keeps all faces")
{
    for (const PolygonMesh& single : {make_noisy_sphere(800), make_quads(900)})
        for (const Laplacian laplacian : all_laplacians)
            for (const Index subdomains : {1, 5}) {
                CAPTURE(name_of(laplacian));
                const PolygonMesh both = doubled(single);
                PolygonMesh moved = both;
                const FlowReport report = mean_curvature_flow(moved, repeated_faces_options(laplacian, subdomains));
                CHECK(moved.face_offsets == both.face_offsets);
                CHECK(moved.face_vertices == both.face_vertices);
                FlowOptions of_single = repeated_faces_options(laplacian, subdomains);
                // That of a mesh whose edges count as often as they are there.
                of_single.uniform_edge = resolved(repeated_faces_options(laplacian, subdomains), both).uniform_edge;
                CHECK(moved.vertices == flowed(single, of_single));
                CHECK(report.mesh.faces == both.n_faces());
                REQUIRE(report.cut.labels.size() == usize(both.n_faces()));
                for (Index f = 0; f < single.n_faces(); ++f)
                    CHECK(report.cut.labels[f] == report.cut.labels[f + single.n_faces()]);
                CHECK(report.mesh.non_manifold_vertices == 0);
            }
}

TEST_CASE("polygons that are divided into triangles are no repeated faces, beside polygons that are")
{
    const PolygonMesh single = make_quads(100);
    for (const bool has_repeated : {false, true}) {
        PolygonMesh given = single;
        if (has_repeated)
            given.add_face(std::vector<Index>(single.face(7).begin(), single.face(7).end()));
        FlowingMesh flowing(given);
        CHECK(flowing.leave_out_repeated_faces(make_topology(flowing.mesh())) == has_repeated);
        PolygonMesh triangles;
        std::vector<Index> face_of;
        for (Index f = 0; f < single.n_faces(); ++f) {
            const auto corners = single.face(f);
            for (const std::size_t k : {1, 2}) {
                triangles.add_face(std::vector{corners[0], corners[k], corners[k + 1]});
                face_of.push_back(f);
            }
        }
        triangles.vertices = single.vertices;
        flowing.replace_faces(triangles, face_of);
        RunReport report;
        report.mesh.faces = flowing.mesh().n_faces();
        flowing.complete(report);
        CHECK(report.mesh.faces == given.n_faces());
        CHECK(report.mesh.repeated_faces ==
              (has_repeated ? std::vector<Index>{single.n_faces()} : std::vector<Index>()));
        CHECK(report.remarks.size() == (has_repeated ? 1 : 0));
    }
}

TEST_CASE("labels of one's own, failures and what the report says")
{
    const PolygonMesh single = make_quads(900);
    PolygonMesh both = doubled(single);
    FlowOptions options = repeated_faces_options(Laplacian::Fujiwara, 0);
    options.cut.labels.assign(both.n_faces(), 0);
    for (Index f = 0; f < both.n_faces(); ++f)
        options.cut.labels[f] = f % single.n_faces() < single.n_faces() / 2 ? 0 : 1;
    PolygonMesh moved = both;
    const FlowReport report = mean_curvature_flow(moved, options);
    CHECK(report.cut.n_sub_meshes() == 2);
    CHECK(report.cut.labels == options.cut.labels);
    CHECK(sentence(report.remarks.back()).find("took no part") != std::string::npos);

    options.cut.labels.pop_back();
    CHECK_THROWS(mean_curvature_flow(both, options));
    CHECK(both.n_faces() == 2 * single.n_faces());
    options.cut.labels.clear();
    options.motion.strict = true;
    CHECK_THROWS(mean_curvature_flow(both, options));
    CHECK_THROWS(mean_curvature_flow(both, repeated_faces_options(Laplacian::Fujiwara, 2),
                                     [](const StepState&) { throw std::runtime_error("stop"); }));
    CHECK(both.n_faces() == 2 * single.n_faces());
}
