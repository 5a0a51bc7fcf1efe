#include <algorithm>

#include <doctest/doctest.h>

#include "partition/connected_components.h"
#include "partition/cut/clusters.h"
#include "samples/meshes/meshes.h"
#include "tests/support/backwards.h"
#include "tests/support/cut_checks.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Index weight_of(const PolygonMesh& mesh, std::span<const Index> faces)
{
    Index weight = 0;
    for (const Index f : faces)
        weight += face_weight(mesh, f);
    return weight;
}

/// The number of clusters that weigh less.
Index n_light(const PolygonMesh& mesh, const FaceClusters& clusters, Index weight)
{
    Index n = 0;
    for (Index cluster = 0; cluster < clusters.size(); ++cluster)
        n += weight_of(mesh, clusters.faces[cluster]) < weight ? 1 : 0;
    return n;
}

}  // namespace

TEST_CASE("every face lies in one cluster, every cluster in one component")
{
    for (const NamedMesh& m : assorted_meshes())
        for (const Index weight : {1, 2, 5, 30, 1000}) {
            CAPTURE(m.name);
            CAPTURE(weight);
            const FaceClusters clusters = grow_clusters(m.mesh, m.topology, weight);
            const Components components = face_components(m.mesh, m.topology);
            std::vector<Index> faces = clusters.faces.values;
            std::sort(faces.begin(), faces.end());
            REQUIRE(faces.size() == usize(m.mesh.n_faces()));
            for (Index f = 0; f < m.mesh.n_faces(); ++f)
                CHECK(faces[f] == f);
            for (Index cluster = 0; cluster < clusters.size(); ++cluster)
                for (const Index f : clusters.faces[cluster]) {
                    CHECK(clusters.cluster_of[f] == cluster);
                    CHECK(components.component_of[f] == components.component_of[clusters.faces[cluster].front()]);
                }
        }
}

TEST_CASE("clusters are connected and about as heavy as asked")
{
    for (const PolygonMesh& mesh :
         {make_quads(2000), make_triangles(2000), make_hexagons(2000), make_mixed_polygons(2000)})
        for (const Index weight : {8, 40}) {
            const Topology topology = make_topology(mesh);
            const FaceClusters clusters = grow_clusters(mesh, topology, weight);
            const auto defect = first_defect(mesh, topology, clusters.cluster_of);
            CHECK((!defect || defect->find("not connected") == std::string::npos));
            for (Index cluster = 0; cluster < clusters.size(); ++cluster)
                CHECK(weight_of(mesh, clusters.faces[cluster]) < 3 * weight);
            CHECK(clusters.size() < 2 * weight_of(mesh, clusters.faces.values) / weight);
        }
}

TEST_CASE("large meshes are done in chunks, in any order, whose ends are no ends of clusters; shuffled ones are not")
{
    constexpr Index chunk = 60'000;
    PolygonMesh mesh = make_triangles(100'000);
    constexpr Index weight = 40;
    const FaceClusters whole = grow_clusters(mesh, make_topology(mesh), weight, run_serially, mesh.n_faces());
    const FaceClusters clusters = grow_clusters(mesh, make_topology(mesh), weight, run_serially, chunk);
    CHECK(whole.size() < 1.2 * weight_of(mesh, whole.faces.values) / weight);
    CHECK(clusters.cluster_of != whole.cluster_of);
    CHECK(clusters.size() < 1.05 * whole.size());
    CHECK(n_light(mesh, clusters, weight / 4) < 0.02 * clusters.size());
    // Of the edges between two chunks about as many are between two clusters as of all: less than half.
    const Topology topology = make_topology(mesh);
    Index n_between_chunks = 0;
    Index n_cut = 0;
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const Index twin = topology.twin[h];
        const Index f = topology.face_of[h];
        if (twin < h || topology.face_of[twin] / chunk == f / chunk)
            continue;
        ++n_between_chunks;
        n_cut += clusters.cluster_of[f] != clusters.cluster_of[topology.face_of[twin]] ? 1 : 0;
    }
    CHECK(n_between_chunks > 100);
    CHECK(2 * n_cut < n_between_chunks);
    const FaceClusters backwards = grow_clusters(mesh, make_topology(mesh), weight, run_backwards, chunk);
    CHECK(backwards.cluster_of == clusters.cluster_of);
    CHECK(backwards.faces.values == clusters.faces.values);
    CHECK(backwards.faces.offsets == clusters.faces.offsets);

    mesh = shuffled(mesh, 1).mesh;
    CHECK(grow_clusters(mesh, make_topology(mesh), weight, run_serially, chunk).cluster_of ==
          grow_clusters(mesh, make_topology(mesh), weight, run_serially, mesh.n_faces()).cluster_of);
}

TEST_CASE("with weight 1 every face is a cluster")
{
    const PolygonMesh mesh = hexagon_sheet(5, 4);
    CHECK(grow_clusters(mesh, make_topology(mesh), 1).size() == 20);
    CHECK(grow_clusters(PolygonMesh{}, make_topology(PolygonMesh{}), 7).size() == 0);
}
