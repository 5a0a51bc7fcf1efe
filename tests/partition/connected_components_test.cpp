#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/connected_components.h"
#include "partition/disjoint_sets.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("components are numbered by their lowest face")
{
    const PolygonMesh mesh = side_by_side({quad_grid(2, 1), quad_torus(3, 3), quad_grid(1, 1)});
    const Components components = face_components(mesh, make_topology(mesh));
    CHECK(components.count() == 3);
    CHECK(components.component_of == std::vector<Index>{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
}

TEST_CASE("the nodes of a component follow each other breadth first from the lowest")
{
    // Two paths, 0 - 4 - 1 - 3 and 2 - 5.
    const std::vector<std::vector<Index>> adjacency{{4}, {3, 4}, {5}, {1}, {1, 0}, {2}};
    const Components components = connected_components(6, [&](Index node, auto&& visit) {
        for (const Index neighbour : adjacency[node])
            visit(neighbour);
    });
    CHECK(components.component_of == std::vector<Index>{0, 0, 1, 0, 0, 1});
    CHECK(components.nodes.offsets == std::vector<Index>{0, 4, 6});
    CHECK(components.nodes.values == std::vector<Index>{0, 4, 1, 3, 2, 5});
}

TEST_CASE("neither a vertex nor an edge of three faces connects")
{
    CHECK(face_components(bow_tie(), make_topology(bow_tie())).count() == 2);
    CHECK(face_components(hourglass(), make_topology(hourglass())).count() == 2);
    CHECK(face_components(three_wings(), make_topology(three_wings())).count() == 3);
}

TEST_CASE("faces at a junction are neighbours of each other, and where they are many, of the next and the previous one")
{
    for (const Index n : {Index{5}, most_mutual_neighbours, most_mutual_neighbours + 1, Index{100000}}) {
        PolygonMesh mesh;
        mesh.vertices = Points::Zero(n + 2, 3);
        for (Index i = 0; i < n; ++i)
            mesh.add_face(std::array<Index, 3>{0, 1, i + 2});
        Topology topology = make_topology(mesh);
        free_junctions(mesh, topology);
        CHECK(face_components(mesh, topology).count() == 1);
        std::vector<Index> neighbours;
        for_each_neighbour(mesh, topology, 0, [&](Index h, Index g) {
            CHECK(h == 0);
            neighbours.push_back(g);
        });
        std::ranges::sort(neighbours);
        if (n > most_mutual_neighbours) {
            CHECK(neighbours == std::vector<Index>{1, n - 1});
        } else {
            CHECK(std::ssize(neighbours) == n - 1);
            CHECK(neighbours.front() == 1);
            CHECK(neighbours.back() == n - 1);
        }
    }
}

TEST_CASE("sets that several threads join are numbered by their lowest members")
{
    constexpr Index n = 100000;
    std::vector<Edge> pairs;
    RandomNumbers random(7);
    for (Index i = 0; i < 6 * n / 10; ++i)
        pairs.push_back({random.below(n), random.below(n)});
    std::vector<std::vector<Index>> adjacency(usize(n));
    for (const auto& [a, b] : pairs) {
        adjacency[a].push_back(b);
        adjacency[b].push_back(a);
    }
    const Components expected = connected_components(n, [&](Index node, auto&& visit) {
        for (const Index neighbour : adjacency[node])
            visit(neighbour);
    });
    for (const Executor& exec : {Executor(run_serially), Executor(run_in_parallel)}) {
        DisjointSets sets(n, exec);
        for_each(exec, static_cast<Index>(pairs.size()), [&](Index i) { sets.join(pairs[i][0], pairs[i][1]); });
        const auto [number, n_sets] = sets.numbered(exec);
        CHECK(n_sets == expected.count());
        CHECK(number == expected.component_of);
    }
}

TEST_CASE("a mesh without faces has no components")
{
    CHECK(face_components(PolygonMesh{}, make_topology(PolygonMesh{})).count() == 0);
}
