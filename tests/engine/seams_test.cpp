#include <algorithm>
#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "partition/weld.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

AllOptions in_sub_meshes()
{
    AllOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.time_step = 0.001;
    options.steps = 3;
    options.cut.subdomains = 4;
    return options;
}

/// Compares bit for bit.
void check_flows_as_one(const PolygonMesh& parts, const PolygonMesh& whole, const AllOptions& options)
{
    const Points expected = flowed(whole, options);
    CHECK(same_bits(flowed(parts, options), expected(originals(parts, whole), Eigen::all)));
}

}  // namespace

TEST_CASE("a surface with seams flows as the one without, bit for bit")
{
    for (const PolygonMesh& whole : height_fields(400)) {
        const PolygonMesh parts = split(whole, halves(whole));
        REQUIRE(parts.n_vertices() > whole.n_vertices() + 5);
        for (const Laplacian laplacian : all_laplacians)
            for (const int threads : {1, 4}) {
                AllOptions options = in_sub_meshes();
                options.laplacian = laplacian;
                options.resources.threads = threads;
                check_flows_as_one(parts, whole, options);
            }
        AllOptions options = in_sub_meshes();
        options.cut.subdomains = 0;
        options.keep_edges = 30.0;
        check_flows_as_one(parts, whole, options);
        options.keep_edges.reset();
        options.accuracy.approach = Approach::Undecomposed;
        check_flows_as_one(parts, whole, options);
        options.motion.boundary = Boundary::Free;
        options.motion.rescale = Rescale::Area;
        check_flows_as_one(parts, whole, options);
    }
}

TEST_CASE("faces that have all their vertices to themselves flow as a closed surface, far from the origin, too")
{
    PolygonMesh whole = triangle_torus(14, 10);
    std::vector<Index> labels;
    for (Index f = 0; f < whole.n_faces(); ++f)
        labels.push_back(f);
    AllOptions options = in_sub_meshes();
    options.time_step = 0.02;
    options.motion.rescale = Rescale::Volume;
    check_flows_as_one(split(whole, labels), whole, options);
    whole.vertices.rowwise() += Point(1e6, 0.0, -1e5);
    check_flows_as_one(split(whole, labels), whole, options);
    options.motion.weld.reset();
    CHECK_THROWS_AS(flowed(split(whole, labels), options), InputError);
}

TEST_CASE("what is said of seams: a remark, who moved with whom, and who was fixed")
{
    const PolygonMesh whole = make_triangles(400);
    PolygonMesh parts = split(whole, halves(whole));
    const Points before = parts.vertices;
    PolygonMesh mesh = whole;
    const FlowReport of_whole = smooth_surface(mesh, in_sub_meshes());
    CHECK(of_whole.mesh.moved_with.empty());
    mesh = parts;
    const FlowReport report = smooth_surface(mesh, in_sub_meshes());
    CHECK(report.mesh.moved_with == originals(parts, whole));
    CHECK(report.mesh.vertices == parts.n_vertices());
    CHECK(count_with(report.remarks, "along seams") == 1);
    // Copies at both ends of the seam lie on the boundary.
    CHECK(report.mesh.fixed_vertices == of_whole.mesh.fixed_vertices + 2);
    CHECK(report.mesh.non_manifold_vertices == 0);

    AllOptions apart = in_sub_meshes();
    apart.motion.weld.reset();
    mesh = parts;
    const FlowReport of_parts = smooth_surface(mesh, apart);
    CHECK(of_parts.mesh.moved_with.empty());
    for (Index v = 0; v < whole.n_vertices(); ++v)
        if (std::ranges::count(report.mesh.moved_with, v) > 1)
            CHECK(mesh.vertices.row(v) == before.row(v));
}

TEST_CASE("a copy that is fixed or attached holds all of them")
{
    const PolygonMesh whole = make_triangles(400);
    const PolygonMesh parts = split(whole, halves(whole));
    const Index copy = parts.n_vertices() - 3;
    const Index first = originals(parts, whole)[copy];
    AllOptions of_parts = in_sub_meshes();
    AllOptions of_whole = in_sub_meshes();
    of_parts.motion.fixed_vertices = {copy};
    of_whole.motion.fixed_vertices = {first};
    const Points held = flowed(parts, of_parts);
    CHECK(held.row(copy) == parts.vertices.row(copy));
    CHECK(same_bits(held.topRows(whole.n_vertices()), flowed(whole, of_whole)));

    of_parts.motion.fixed_vertices.clear();
    of_whole.motion.fixed_vertices.clear();
    of_parts.motion.attachment_weights.assign(usize(parts.n_vertices()), 1.0);
    of_whole.motion.attachment_weights.assign(usize(whole.n_vertices()), 1.0);
    of_parts.motion.attachment_weights[copy] = of_whole.motion.attachment_weights[first] = 500.0;
    CHECK(same_bits(flowed(parts, of_parts).topRows(whole.n_vertices()), flowed(whole, of_whole)));
}

TEST_CASE("feature edges may name any copies of the vertices along a seam")
{
    const PolygonMesh whole = make_triangles(400);
    const PolygonMesh parts = split(whole, halves(whole));
    AllOptions of_parts;
    of_parts.keep_edges = 30.0;
    of_parts.time_step = 0.01;
    AllOptions of_whole = of_parts;
    // All edges between copies: those along the seam in the second part.
    const std::vector<Index> of = originals(parts, whole);
    for (Index f = 0; f < parts.n_faces(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            if (const Edge edge{parts.face(f)[k], parts.face(f)[(k + 1) % 3]};
                std::min(edge[0], edge[1]) >= whole.n_vertices()) {
                of_parts.motion.feature_edges.push_back(edge);
                of_whole.motion.feature_edges.push_back({of[edge[0]], of[edge[1]]});
            }
    REQUIRE(of_parts.motion.feature_edges.size() > 5);
    check_flows_as_one(parts, whole, of_whole);
    const Points expected = flowed(whole, of_whole);
    CHECK(same_bits(flowed(parts, of_parts), expected(of, Eigen::all)));
    CHECK_FALSE(same_bits(expected, flowed(whole, [&] {
                              AllOptions without = of_whole;
                              without.motion.feature_edges.clear();
                              return without;
                          }())));
}

TEST_CASE("copies that are a little apart come to one place, and stay where they are if that is fixed")
{
    const PolygonMesh whole = make_quads(400);
    PolygonMesh parts = split(whole, halves(whole));
    const std::vector<Index> of = originals(parts, whole);
    for (Index v = whole.n_vertices(); v < parts.n_vertices(); ++v)
        parts.vertices.row(v) += Point(1e-5, 0.0, -1e-5);
    AllOptions options = in_sub_meshes();
    options.motion.weld = 1e-4;
    options.motion.fixed_vertices = {parts.n_vertices() - 2};
    const Topology topology = make_topology(whole);
    const Points moved = flowed(parts, options);
    for (Index v = whole.n_vertices(); v < parts.n_vertices(); ++v) {
        const bool stays = topology.kind[of[v]] == VertexKind::Boundary || v == parts.n_vertices() - 2;
        for (const Index w : {v, of[v]}) {
            CHECK((moved.row(w) == parts.vertices.row(w)) == stays);
            CHECK((moved.row(w) == moved.row(v)) == (w == v || !stays));
        }
    }
    // Where nothing flows nothing is moved.
    options.steps = 0;
    CHECK(same_bits(flowed(parts, options), parts.vertices));
}

TEST_CASE("a distance that joins a tenth of all vertices is warned of, unless they were as near as copies are")
{
    const PolygonMesh whole = make_quads(250);
    PolygonMesh parts = split(whole, halves(whole));
    const auto remarks = [&](double distance) {
        PolygonMesh mesh = parts;
        AllOptions options = in_sub_meshes();
        options.motion.weld = distance;
        for (const std::string& remark : sentences(smooth_surface(mesh, options).remarks))
            if (remark.find("along seams") != std::string::npos || remark.starts_with("weld has joined no vertices"))
                return remark;
        return std::string();
    };
    const Index n_seam = parts.n_vertices() - whole.n_vertices();
    const std::string count = std::to_string(2 * n_seam) + " vertices along seams, where " + std::to_string(n_seam - 1);
    CHECK(remarks(0.0) == count + " pairs of boundary edges lie on each other, flowed as one; they are still separate "
                                  "vertices.");
    for (Index v = whole.n_vertices(); v < parts.n_vertices(); ++v)
        parts.vertices.row(v) += Point(1e-5, 0.0, -1e-5);
    CHECK(
        remarks(1e-4).starts_with(count + " pairs of boundary edges lie within 0.0001 of each other, flowed as one; "));
    CHECK(remarks(1e-4).find("make weld smaller") == std::string::npos);
    for (Index v = whole.n_vertices(); v < parts.n_vertices(); ++v)
        parts.vertices.row(v) += Point(2e-3, 0.0, 0.0);
    REQUIRE(20 * n_seam >= parts.n_vertices());
    CHECK(remarks(5e-3).find("make weld smaller") != std::string::npos);
    // All is within reach of all.
    CHECK(remarks(100.0).starts_with("weld has joined no vertices: no seam has pairs of boundary edges within 100 "));
    CHECK_FALSE(remark_on_seams(0, 0, 1000, 0.0, 0.0));
    const auto remark = [](Index n_vertices, Index n_edges, double apart) {
        return sentence(remark_on_seams(n_vertices, n_edges, 1000, 0.1, apart).value(), [](auto, auto) { return "W"; });
    };
    CHECK(remark(99, 1, 0.1).find("W") == std::string::npos);
    CHECK(remark(100, 1, 0.1).find(", and 10% of all: ") != std::string::npos);
    CHECK(remark(100, 1, 0.1).find(" make W smaller") != std::string::npos);
    CHECK(remark(1000, 900, 0.001).find("W") == std::string::npos);
}

TEST_CASE("sub-meshes that are written as they are keep seams, and what an observer sees has all vertices")
{
    const PolygonMesh whole = make_triangles(400);
    const PolygonMesh parts = split(whole, halves(whole));
    const std::vector<Index> of = originals(parts, whole);
    AllOptions options = in_sub_meshes();
    options.interface.conditions = Conditions::Robin;
    options.report.keep_gaps = true;
    options.report.reference = true;
    PolygonMesh mesh = parts;
    std::vector<Points> seen;
    FlowReport report = smooth_surface(mesh, options, [&](const StepState& state) {
        seen = {state.positions, *state.reference_positions, state.separated->vertices};
    });
    PolygonMesh mesh_of_whole = whole;
    std::vector<Points> seen_of_whole;
    const FlowReport of_whole = smooth_surface(mesh_of_whole, options, [&](const StepState& state) {
        seen_of_whole = {state.positions, *state.reference_positions};
    });
    for (const std::size_t i : {0, 1})
        CHECK(same_bits(seen[i], seen_of_whole[i](of, Eigen::all)));
    REQUIRE(report.separated);
    CHECK(seen[2] == report.separated->vertices);
    CHECK(report.separated->n_vertices() == of_whole.separated->n_vertices() + parts.n_vertices() - whole.n_vertices());
    const PolygonMesh& separated = *report.separated;
    for (std::size_t corner = 0; corner < parts.face_vertices.size(); ++corner) {
        const Index v = separated.face_vertices[corner];
        if (v < parts.n_vertices())
            CHECK(v == parts.face_vertices[corner]);
        CHECK(separated.vertices.row(v) == of_whole.separated->vertices.row(of_whole.separated->face_vertices[corner]));
    }
}
