#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

using Edge = std::pair<Index, Index>;

Edge edge_of(const PolygonMesh& mesh, const Topology& topology, Index h)
{
    return std::minmax(mesh.face_vertices[h], mesh.face_vertices[topology.next(mesh, h)]);
}

Index count(const Topology& topology, VertexKind kind)
{
    return static_cast<Index>(std::count(topology.kind.begin(), topology.kind.end(), kind));
}

void check_twins(const PolygonMesh& mesh, const Topology& topology)
{
    std::multiset<Edge> edges;
    for (Index h = 0; h < mesh.n_corners(); ++h)
        edges.insert(edge_of(mesh, topology, h));
    REQUIRE(topology.twin.size() == usize(mesh.n_corners()));
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const Index twin = topology.twin[h];
        CHECK((twin >= 0) == (edges.count(edge_of(mesh, topology, h)) == 2));
        if (twin < 0)
            continue;
        CHECK(twin != h);
        CHECK(topology.twin[twin] == h);
        CHECK(topology.face_of[twin] != topology.face_of[h]);
        CHECK(edge_of(mesh, topology, twin) == edge_of(mesh, topology, h));
    }
}

void check_corners(const PolygonMesh& mesh, const Topology& topology)
{
    std::size_t n_corners = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const auto corners = topology.corners_at(v);
        n_corners += corners.size();
        CHECK(std::is_sorted(corners.begin(), corners.end()));
        CHECK(corners.empty() == (topology.kind[v] == VertexKind::Isolated));
        for (const Index h : corners) {
            CHECK(mesh.face_vertices[h] == v);
            CHECK(topology.next(mesh, topology.previous(mesh, h)) == h);
            CHECK(topology.previous(mesh, topology.next(mesh, h)) == h);
        }
    }
    CHECK(n_corners == mesh.face_vertices.size());
}

/// Every face with the label at v lies in one fan; consecutive ones share an edge at v, and so do first and last faces
/// of a closed fan.
void check_fans(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index label, Index v)
{
    const auto belongs = [&](Index h) { return labels.empty() || labels[topology.face_of[h]] == label; };
    const auto share_spoke = [&](Index a, Index b) {
        for (const Index h : {a, topology.previous(mesh, a)})
            if (const Index twin = topology.twin[h]; twin >= 0 && (twin == b || twin == topology.previous(mesh, b)))
                return true;
        return false;
    };
    const auto corners = topology.corners_at(v);
    std::vector<Index> found;
    for (const Fan& fan : fans_at(mesh, topology, v, labels, label)) {
        REQUIRE(!fan.corners.empty());
        for (std::size_t i = 0; i + 1 < fan.corners.size(); ++i)
            CHECK(share_spoke(fan.corners[i], fan.corners[i + 1]));
        CHECK((fan.first == fan.last) == fan.closed);
        if (fan.closed)
            CHECK(share_spoke(fan.corners.back(), fan.corners.front()));
        for (const auto& [corner, end] :
             {std::pair(fan.corners.front(), fan.first), std::pair(fan.corners.back(), fan.last)})
            CHECK((mesh.face_vertices[topology.next(mesh, corner)] == end ||
                   mesh.face_vertices[topology.previous(mesh, corner)] == end));
        // Fans that share a spoke would be one.
        for (const Index other : found)
            for (const Index corner : fan.corners)
                CHECK_FALSE(share_spoke(other, corner));
        found.insert(found.end(), fan.corners.begin(), fan.corners.end());
    }
    std::sort(found.begin(), found.end());
    std::vector<Index> expected;
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(expected), belongs);
    CHECK(found == expected);
}

}  // namespace

TEST_CASE("the face of a half-edge, and those beside it there, whether all faces have as many corners or not")
{
    for (Index degree = 3; degree <= 70; ++degree) {
        for (const Index last_degree : {degree, degree + 1}) {
            CAPTURE(degree);
            CAPTURE(last_degree);
            PolygonMesh mesh;
            for (Index f = 0; f < 40; ++f) {
                std::vector<Index> corners(f == 39 ? last_degree : degree);
                std::iota(corners.begin(), corners.end(), mesh.n_corners());
                mesh.add_face(corners);
            }
            mesh.vertices = Points::Zero(mesh.n_corners(), 3);
            const Topology topology = make_topology(mesh);
            for (Index f = 0; f < mesh.n_faces(); ++f) {
                const Index begin = mesh.face_offsets[f];
                const Index end = mesh.face_offsets[f + 1];
                for (Index h = begin; h < end; ++h) {
                    REQUIRE(topology.face_of[h] == f);
                    REQUIRE(topology.next(mesh, h) == (h + 1 == end ? begin : h + 1));
                    REQUIRE(topology.previous(mesh, h) == (h == begin ? end - 1 : h - 1));
                }
            }
        }
    }
}

TEST_CASE("the face of a half-edge is right for as many half-edges as there can be")
{
    constexpr std::int64_t end = std::int64_t{1} << 31;
    for (const Index degree : {3, 4, 5, 6, 7, 11, 64, 1000, 65537, 1 << 20}) {
        CAPTURE(degree);
        PolygonMesh mesh;
        mesh.face_offsets = {0, degree};
        const FaceOfHalfedge face_of(mesh, run_serially);
        const std::int64_t last = (end - 1) / degree;
        for (const std::int64_t face : {std::int64_t{1}, last / 3, last / 2, last - 1, last})
            for (const std::int64_t h : {face * degree - 1, face * degree, face * degree + degree - 1})
                if (h < end)
                    CHECK(face_of[static_cast<std::size_t>(h)] == h / degree);
        CHECK(face_of[static_cast<std::size_t>(end - 1)] == last);
    }
}

TEST_CASE("the ends of a fan are found without listing it")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        std::vector<Index> labels(m.mesh.n_faces());
        for (Index f = 0; f < m.mesh.n_faces(); ++f)
            labels[f] = f * 7 % 5 % 2;
        for (Index v = 0; v < m.mesh.n_vertices(); ++v)
            for (const Index label : {0, 1})
                for (const Fan& fan : fans_at(m.mesh, m.topology, v, labels, label)) {
                    const Index lowest = *std::min_element(fan.corners.begin(), fan.corners.end());
                    if (!fan.closed)
                        CHECK(ends_of_fan(m.mesh, m.topology, lowest, labels) == std::pair(fan.first, fan.last));
                }
    }
}

TEST_CASE("twins are mutual and join the two faces of an edge, whichever way the faces run")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        check_twins(m.mesh, m.topology);
        check_corners(m.mesh, m.topology);
        const PolygonMesh mixed = with_faces_flipped(m.mesh, 3);
        const Topology topology = make_topology(mixed);
        check_twins(mixed, topology);
        CHECK(topology.kind == m.topology.kind);
    }
}

TEST_CASE("a closed mesh has interior vertices only")
{
    for (const PolygonMesh& mesh : {quad_torus(9, 5), triangle_torus(3, 3), make_noisy_sphere(200)}) {
        const Topology topology = make_topology(mesh);
        CHECK(count(topology, VertexKind::Interior) == mesh.n_vertices());
        CHECK(std::none_of(topology.twin.begin(), topology.twin.end(), [](Index twin) { return twin < 0; }));
    }
}

TEST_CASE("the boundary of an open mesh is found")
{
    const Topology grid = make_topology(quad_grid(5, 4));
    CHECK(count(grid, VertexKind::Boundary) == 18);
    CHECK(count(grid, VertexKind::Interior) == 12);
    const Topology tube = make_topology(cylinder(7, 3));
    CHECK(count(tube, VertexKind::Boundary) == 14);
    CHECK(count(tube, VertexKind::Interior) == 14);
}

TEST_CASE("a Möbius band is a manifold with one boundary")
{
    const PolygonMesh mesh = moebius_band(10, 4);
    const Topology topology = make_topology(mesh);
    check_twins(mesh, topology);
    CHECK(count(topology, VertexKind::NonManifold) == 0);
    CHECK(count(topology, VertexKind::Boundary) == 20);
    CHECK(count(topology, VertexKind::Interior) == 30);
    CHECK(std::count(topology.twin.begin(), topology.twin.end(), -1) == 20);
}

TEST_CASE("an edge of three faces pairs nothing and its ends are not manifold")
{
    const PolygonMesh mesh = three_wings();
    const Topology topology = make_topology(mesh);
    CHECK(std::count(topology.twin.begin(), topology.twin.end(), -1) == 9);
    CHECK(topology.kind == std::vector<VertexKind>{VertexKind::NonManifold, VertexKind::NonManifold,
                                                   VertexKind::Boundary, VertexKind::Boundary, VertexKind::Boundary});
}

TEST_CASE("faces at an edge of three are linked in a circle, and its ends move unless they are on the boundary")
{
    const PolygonMesh wings = three_wings();
    Topology topology = make_topology(wings);
    CHECK(topology.next_at_junction(0) == 0);
    free_junctions(wings, topology);
    CHECK(topology.kind == std::vector<VertexKind>(5, VertexKind::Boundary));
    CHECK(std::count(topology.fixed.begin(), topology.fixed.end(), 0) == 0);
    REQUIRE(topology.junctions.size() == 3);
    for (const JunctionLink& link : topology.junctions) {
        CHECK(topology.next_at_junction(link.halfedge) == link.next);
        CHECK(topology.next_at_junction(topology.next_at_junction(link.next)) == link.halfedge);
    }
    // Three tetrahedra around an edge.
    PolygonMesh closed;
    closed.vertices = Points::Random(5, 3);
    for (const Index v : {2, 3, 4}) {
        const Index w = v == 4 ? 2 : v + 1;
        closed.add_face(std::array<Index, 3>{0, 1, v});
        closed.add_face(std::array<Index, 3>{0, v, w});
        closed.add_face(std::array<Index, 3>{1, w, v});
    }
    topology = make_topology(closed);
    free_junctions(closed, topology);
    CHECK(count(topology, VertexKind::Junction) == 5);
    CHECK(std::count(topology.fixed.begin(), topology.fixed.end(), 0) == 5);
    CHECK(topology.junctions.size() == 21);
    Topology touching = make_topology(hourglass());
    free_junctions(hourglass(), touching);
    CHECK(touching.junctions.empty());
    CHECK(touching.kind[0] == VertexKind::NonManifold);
    CHECK_FALSE(touching.moves(0));
}

TEST_CASE("where two open fans meet is boundary, where two closed ones meet is not manifold")
{
    const Topology open = make_topology(bow_tie());
    CHECK(count(open, VertexKind::Boundary) == 7);
    CHECK(fans_at(bow_tie(), open, 3, {}, 0).size() == 2);
    const Topology closed = make_topology(hourglass());
    CHECK(closed.kind[0] == VertexKind::NonManifold);
    CHECK(count(closed, VertexKind::Interior) == 6);
    const auto fans = fans_at(hourglass(), closed, 0, {}, 0);
    REQUIRE(fans.size() == 2);
    CHECK((fans[0].closed && fans[1].closed));
}

TEST_CASE("vertices without faces are isolated")
{
    PolygonMesh mesh = quad_grid(2, 2);
    mesh.vertices.conservativeResize(11, 3);
    mesh.vertices.bottomRows(2).setOnes();
    const Topology topology = make_topology(mesh);
    CHECK(count(topology, VertexKind::Isolated) == 2);
    CHECK(topology.kind[9] == VertexKind::Isolated);
    CHECK(topology.kind[10] == VertexKind::Isolated);
    CHECK(fans_at(mesh, topology, 10, {}, 0).empty());
}

TEST_CASE("two faces glued along all their edges close a fan at each vertex")
{
    PolygonMesh pillow = quad_grid(1, 1);
    pillow.add_face(std::vector<Index>(pillow.face(0).begin(), pillow.face(0).end()));
    const Topology topology = make_topology(pillow);
    check_twins(pillow, topology);
    CHECK(count(topology, VertexKind::Interior) == 4);
    for (Index v = 0; v < 4; ++v)
        CHECK(fans_at(pillow, topology, v, {}, 0).front().closed);
}

TEST_CASE("the fans of a label are its faces, run by run")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        const auto labels = random_labels(m.mesh.n_faces(), 2, 11);
        const PolygonMesh mixed = with_faces_flipped(m.mesh, 5);
        const Topology topology = make_topology(mixed);
        for (Index v = 0; v < m.mesh.n_vertices(); ++v) {
            check_fans(m.mesh, m.topology, {}, 0, v);
            for (const Index label : {0, 1}) {
                check_fans(m.mesh, m.topology, labels, label, v);
                check_fans(mixed, topology, labels, label, v);
            }
        }
    }
}

TEST_CASE("at first interior vertices move, with a free boundary those on it too, and those held never")
{
    const PolygonMesh mesh = side_by_side({quad_grid(4, 4), three_wings()});
    Topology topology = make_topology(mesh);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        CHECK(topology.moves(v) == (topology.kind[v] == VertexKind::Interior));
    free_boundary(topology);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        CHECK(topology.moves(v) ==
              (topology.kind[v] == VertexKind::Interior || topology.kind[v] == VertexKind::Boundary));
    REQUIRE(topology.moves(0));
    fix_vertices(topology, std::vector<Index>{0, 6, 0});
    CHECK_FALSE(topology.moves(0));
    CHECK_FALSE(topology.moves(6));
    CHECK_THROWS_AS(fix_vertices(topology, std::vector<Index>{mesh.n_vertices()}), InputError);
    CHECK_THROWS_AS(fix_vertices(topology, std::vector<Index>{-1}), InputError);
}
