#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/still_faces.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "partition/errors.h"
#include "partition/vector_area.h"
#include "tests/engine/distributed/parts.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

TEST_CASE("every face comes to the rank of its sub-mesh, and ranks get about as much")
{
    PolygonMesh mesh = make_mixed_polygons(2000);
    // Two vertices without faces.
    mesh.vertices.conservativeResize(mesh.n_vertices() + 2, 3);
    mesh.vertices.bottomRows(2).setConstant(7.0);
    constexpr Index n_labels = 40;
    const std::vector<Index> labels = test::random_labels(mesh.n_faces(), n_labels, 3);
    for (const int n : {1, 2, 3, 5, 8}) {
        CAPTURE(n);
        std::mutex mutex;
        std::vector<int> seen(mesh.n_faces(), 0);
        std::map<Index, int> rank_of;
        run_on_threads(n, [&](Transport& transport) {
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = test::slice_of(mesh, labels, comm.rank(), n);
                // In short numbers and in long ones.
                MeshPart part = n % 2 == 0 ? deal(comm, slice) : deal(comm, slice, 0);
                require_valid(part);
                const std::scoped_lock lock(mutex);
                CHECK(part.mesh.n_corners() < 1.6 * mesh.n_corners() / n);
                CHECK(part.mesh.n_corners() > 0.5 * mesh.n_corners() / n);
                for (Index f = 0; f < part.mesh.n_faces(); ++f) {
                    const auto number = static_cast<Index>(part.face_numbers[f]);
                    ++seen[number];
                    CHECK(part.labels[f] == labels[number]);
                    CHECK(rank_of.emplace(labels[number], comm.rank()).first->second == comm.rank());
                    const auto expected = mesh.face(number);
                    const auto corners = part.mesh.face(f);
                    REQUIRE(corners.size() == expected.size());
                    for (std::size_t k = 0; k < corners.size(); ++k) {
                        CHECK(part.vertex_numbers[corners[k]] == expected[k]);
                        CHECK(Point(part.mesh.vertices.row(corners[k])) == Point(mesh.vertices.row(expected[k])));
                    }
                }
            });
        });
        CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
        CHECK(std::ranges::is_sorted(rank_of, {}, [](const auto& label_and_rank) { return label_and_rank.second; }));
    }
}

TEST_CASE("faces on which no moving vertex depends are left out on all ranks, and their area is known")
{
    const PolygonMesh mesh = make_mixed_polygons(12'000);
    const std::vector<Index> labels(at(mesh.n_faces()), 0);
    std::vector<double> strengths(at(mesh.n_vertices()), 0.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        strengths[v] = mesh.vertices(v, 0) > 0.7 ? 0.5 : 0.0;
    double area_left = 0.0;
    double area_of_all = 0.0;
    Index n_left = 0;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const bool moves = std::ranges::any_of(mesh.face(f), [&](Index v) { return strengths[v] > 0.0; });
        const double area = vector_area(mesh.face(f), mesh.vertices).norm();
        area_of_all += area;
        area_left += moves ? area : 0.0;
        n_left += moves ? 1 : 0;
    }
    for (const int n : {1, 2, 3})
        run_on_threads(n, [&](Transport& transport) {
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = test::slice_of(mesh, labels, comm.rank(), n);
                const Index n_before = slice.n_faces();
                const SliceBounds bounds = gather_bounds(comm, slice);
                const auto begin = static_cast<std::size_t>(bounds.vertices[at(comm.rank())]);
                const auto n_own = static_cast<std::size_t>(slice.vertices.rows());
                const StillFaces still = leave_out_still_faces(comm, std::span(strengths).subspan(begin, n_own), slice);
                CHECK(still.n_left == n_left);
                CHECK(still.area == test::relative(area_of_all - area_left, 1e-12));
                CHECK(slice.n_faces() + std::ssize(still.faces) == n_before);
                CHECK(slice.labels.size() == at(slice.n_faces()));
                CHECK(Point(still.box.high) == Point(mesh.vertices.colwise().maxCoeff()));
            });
        });
}

TEST_CASE("positions come back to where they were read")
{
    PolygonMesh mesh = make_triangles(1000);
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.bottomRows(1).setConstant(7.0);
    const std::vector<Index> labels = test::random_labels(mesh.n_faces(), 20, 5);
    for (const int n : {1, 3, 5})
        run_on_threads(n, [&](Transport& transport) {
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = test::slice_of(mesh, labels, comm.rank(), n);
                MeshPart part = deal(comm, slice);
                part.mesh.vertices *= 2.0;
                collect_positions(comm, part.vertex_numbers, part.mesh.vertices, slice);
                PolygonMesh moved = mesh;
                moved.vertices.topRows(mesh.n_vertices() - 1) *= 2.0;
                CHECK(test::same_bits(slice.vertices, test::slice_of(moved, labels, comm.rank(), n).vertices));
            });
        });
}

TEST_CASE("a corner that is none of the mesh's vertices is named on all ranks")
{
    const PolygonMesh mesh = make_triangles(300);
    const std::vector<Index> labels(mesh.n_faces(), 0);
    run_on_threads(3, [&](Transport& transport) {
        std::string message;
        try {
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = test::slice_of(mesh, labels, comm.rank(), 3);
                if (comm.rank() == 1)
                    slice.corners[4] = mesh.n_vertices();
                deal(comm, slice);
            });
        } catch (const InputError& error) {
            message = error.what();
        }
        const std::string face = std::to_string(mesh.n_faces() / 3 + 1);
        CHECK(message.starts_with("rank 1 on this process: face " + face + " (numbered from 0) names vertex "));
    });
}

TEST_CASE("a part grows by whole layers of faces, whoever has them")
{
    for (const PolygonMesh& mesh : {make_triangles(400), make_mixed_polygons(300), test::bow_tie()}) {
        MeshPart whole{.mesh = mesh, .vertex_numbers = {}, .face_numbers = {}, .labels = {}};
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            whole.vertex_numbers.push_back(v);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            whole.face_numbers.push_back(f);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            whole.labels.push_back(f % 7);
        for (const int n : {1, 2, 3, 5, 8})
            for (const Index n_together : {1, 30}) {
                CAPTURE(n);
                CAPTURE(n_together);
                run_on_threads(n, [&](Transport& transport) {
                    std::vector<Index> faces;
                    for (Index f = 0; f < mesh.n_faces(); ++f)
                        if (f / n_together % n == transport.rank())
                            faces.push_back(f);
                    const MeshPart own = some_faces(whole, faces);
                    MeshPart grown;
                    run_together(transport, [&](Communicator& comm) { grown = grown_by_layers(comm, own, 2); });
                    for (int layer = 0; layer < 2; ++layer) {
                        std::set<Index> vertices;
                        for (const Index f : faces)
                            vertices.insert(mesh.face(f).begin(), mesh.face(f).end());
                        faces.clear();
                        for (Index f = 0; f < mesh.n_faces(); ++f)
                            if (std::ranges::any_of(mesh.face(f), [&](Index v) { return vertices.contains(v); }))
                                faces.push_back(f);
                    }
                    const MeshPart expected = some_faces(whole, faces);
                    CHECK(grown.face_numbers == expected.face_numbers);
                    CHECK(grown.vertex_numbers == expected.vertex_numbers);
                    CHECK(grown.labels == expected.labels);
                    CHECK(grown.mesh.face_offsets == expected.mesh.face_offsets);
                    CHECK(grown.mesh.face_vertices == expected.mesh.face_vertices);
                    CHECK(test::same_bits(grown.mesh.vertices, expected.mesh.vertices));
                });
            }
    }
}
