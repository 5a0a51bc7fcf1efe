#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/cut/distributed_cut.h"
#include "engine/distributed/cut/hilbert.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "partition/cut/cut.h"
#include "partition/repair/repair.h"
#include "partition/vector_area.h"
#include "partition/weld.h"
#include "tests/engine/distributed/parts.h"
#include "tests/support/flows.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

struct FoundCut {
    std::vector<Index> labels;
    DistributedCut cut;
};

/// The cut that n ranks find.
/// @param given labels to begin with; empty: none.
FoundCut cut_by_ranks(const PolygonMesh& mesh, Index k, const CutUnits& units, int n,
                      const std::vector<Index>& given = {})
{
    FoundCut found;
    found.labels.resize(mesh.n_faces());
    const std::vector<Index> first = given.empty() ? std::vector<Index>(mesh.n_faces(), 0) : given;
    FlowOptions options;
    options.cut.subdomains = k;
    options.resources.threads = 1;
    std::mutex mutex;
    run_on_threads(n, [&](Transport& transport) {
        run_together(transport, [&](Communicator& comm) {
            RankSlice slice = test::slice_of(mesh, first, comm.rank(), n);
            const DistributedCut cut = given.empty() ? cut_together(comm, slice, options, units)
                                                     : cut_together_by_labels(comm, slice, options, units);
            const std::vector<Index> labels = labels_of_all_faces(comm, slice, cut.left_out);
            const std::scoped_lock lock(mutex);
            const auto begin = static_cast<Index>(std::int64_t{mesh.n_faces()} * comm.rank() / n);
            std::ranges::copy(labels, found.labels.begin() + begin);
            found.cut = cut;
        });
    });
    return found;
}

/// Checks that every part is a manifold with boundary, and that no label is missing.
void check_sound(const PolygonMesh& mesh, const FoundCut& found)
{
    const Topology topology = make_topology(mesh);
    std::vector<Index> labels = found.labels;
    CHECK(repair(mesh, topology, labels) == 0);
    CHECK(labels == found.labels);
    CHECK(std::set<Index>(labels.begin(), labels.end()).size() == at(found.cut.n_parts));
}

/// The numbers of their faces.
std::vector<Index> part_sizes(const std::vector<Index>& labels, Index n_parts)
{
    std::vector<Index> sizes(at(n_parts), 0);
    for (const Index label : labels)
        ++sizes[label];
    return sizes;
}

Index largest_part(const std::vector<Index>& labels, Index n_parts)
{
    const std::vector<Index> sizes = part_sizes(labels, n_parts);
    return *std::ranges::max_element(sizes);
}

Index smallest_part(const std::vector<Index>& labels, Index n_parts)
{
    const std::vector<Index> sizes = part_sizes(labels, n_parts);
    return *std::ranges::min_element(sizes);
}

/// The number of edges between parts.
Index cut_edges(const PolygonMesh& mesh, const std::vector<Index>& labels)
{
    const Topology topology = make_topology(mesh);
    Index n = 0;
    for (Index h = 0; h < mesh.n_corners(); ++h)
        if (const Index twin = topology.twin[h]; twin > h)
            n += labels[topology.face_of[h]] != labels[topology.face_of[twin]] ? 1 : 0;
    return n;
}

/// A mesh with a further triangle on every tenth of its edges, so that those have three faces.
PolygonMesh with_fins(PolygonMesh mesh)
{
    const Topology topology = make_topology(mesh);
    std::vector<Point> tips;
    const Index n_halfedges = mesh.n_corners();
    const Index n_vertices = mesh.n_vertices();
    for (Index h = 0; h < n_halfedges; h += 10) {
        const Index from = mesh.face_vertices[h];
        const Index to = mesh.face_vertices[topology.next(mesh, h)];
        const std::array<Index, 3> fin{from, to, n_vertices + static_cast<Index>(tips.size())};
        tips.push_back(1.1 * mesh.vertices.row(from));
        mesh.add_face(fin);
    }
    mesh.vertices.conservativeResize(n_vertices + std::ssize(tips), 3);
    for (std::size_t i = 0; i < tips.size(); ++i)
        mesh.vertices.row(n_vertices + static_cast<Index>(i)) = tips[i];
    return mesh;
}

/// Surfaces of all kinds, with more than one chunk of a thousand faces.
std::vector<std::pair<std::string, PolygonMesh>> examples()
{
    return {{"torus", test::triangle_torus(90, 60)},
            {"quads", test::quad_torus(70, 60)},
            {"band", test::moebius_band(600, 10)},
            {"polygons", make_mixed_polygons(4000)},
            {"sphere", make_noisy_sphere(6000)},
            {"three", test::side_by_side({test::triangle_torus(40, 30), make_hexagons(1500), test::cylinder(30, 40)})}};
}

}  // namespace

TEST_CASE("Hilbert's curve goes from cell to neighbouring cell, through all")
{
    constexpr std::uint32_t side = 8;
    std::vector<std::pair<std::uint64_t, std::array<std::uint32_t, 3>>> cells;
    for (std::uint32_t x = 0; x < side; ++x)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t z = 0; z < side; ++z)
                cells.push_back({hilbert_code({x, y, z}), {x, y, z}});
    std::ranges::sort(cells);
    for (std::size_t i = 1; i < cells.size(); ++i) {
        CHECK(cells[i].first == cells[i - 1].first + 1);
        int steps = 0;
        for (std::size_t c = 0; c < 3; ++c)
            steps += std::abs(static_cast<int>(cells[i].second[c]) - static_cast<int>(cells[i - 1].second[c]));
        CHECK(steps == 1);
    }
}

TEST_CASE("a mesh of one chunk is cut as on one machine")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    const Cut expected = cut_into(mesh, make_topology(mesh), 12);
    for (const int n : {1, 3}) {
        const FoundCut found = cut_by_ranks(mesh, 12, {.faces_of_chunk = mesh.n_faces()}, n);
        CHECK(found.labels == expected.labels);
        CHECK(found.cut.n_parts == expected.n_parts);
    }
}

TEST_CASE("a mesh of several chunks is cut alike by any number of ranks, and every part is sound")
{
    for (const auto& example : examples())
        for (const Index chunk : {300, 1000}) {
            const PolygonMesh& mesh = example.second;
            CAPTURE(example.first);
            CAPTURE(chunk);
            constexpr Index k = 20;
            const FoundCut found = cut_by_ranks(mesh, k, {.faces_of_chunk = chunk}, 1);
            check_sound(mesh, found);
            CHECK(found.cut.n_parts == k);
            const Cut serial = cut_into(mesh, make_topology(mesh), k);
            CHECK(largest_part(found.labels, k) < 1.25 * largest_part(serial.labels, k));
            CHECK(cut_edges(mesh, found.labels) < 1.25 * cut_edges(mesh, serial.labels));
            for (const int n : {2, 3, 5, 8}) {
                CAPTURE(n);
                const FoundCut other = cut_by_ranks(mesh, k, {.faces_of_chunk = chunk}, n);
                CHECK(other.labels == found.labels);
                CHECK(other.cut.repaired_faces == found.cut.repaired_faces);
                CHECK(other.cut.remarks == found.cut.remarks);
            }
        }
}

TEST_CASE("a mesh so large that faces are put into clusters is cut alike by any number of ranks")
{
    // In parts of about 3,000 faces.
    const PolygonMesh mesh = make_triangles(160'000);
    constexpr Index k = 100;
    const FoundCut found = cut_by_ranks(mesh, k, {.faces_of_chunk = 40'000}, 1);
    check_sound(mesh, found);
    CHECK(found.cut.n_parts == k);
    const Cut serial = cut_into(mesh, make_topology(mesh), k);
    CHECK(largest_part(found.labels, k) < 1.1 * largest_part(serial.labels, k));
    CHECK(cut_edges(mesh, found.labels) < 1.1 * cut_edges(mesh, serial.labels));
    CAPTURE(cut_edges(mesh, found.labels));
    CAPTURE(cut_edges(mesh, serial.labels));
    CHECK(cut_by_ranks(mesh, k, {.faces_of_chunk = 40'000}, 3).labels == found.labels);
}

TEST_CASE("blocks of chunks are divided apart, alike by any number of ranks")
{
    for (const auto& example : examples()) {
        const PolygonMesh& mesh = example.second;
        CAPTURE(example.first);
        constexpr Index k = 24;
        const CutUnits in_one{.faces_of_chunk = 300};
        const CutUnits units{.faces_of_chunk = 300, .chunks_of_block = 4};
        REQUIRE(mesh.n_faces() > 2 * 4 * 300);
        const FoundCut found = cut_by_ranks(mesh, k, units, 1);
        check_sound(mesh, found);
        CHECK(found.labels != cut_by_ranks(mesh, k, in_one, 1).labels);
        CHECK(found.cut.n_parts >= k - 2);
        CHECK(found.cut.n_parts <= k + 3);
        CHECK(smallest_part(found.labels, found.cut.n_parts) > mesh.n_faces() / k / 4);
        const Cut serial = cut_into(mesh, make_topology(mesh), k);
        CHECK(largest_part(found.labels, found.cut.n_parts) < 1.8 * largest_part(serial.labels, k));
        CHECK(cut_edges(mesh, found.labels) < 1.5 * cut_edges(mesh, serial.labels));
        for (const int n : {2, 3, 5, 8}) {
            CAPTURE(n);
            const FoundCut other = cut_by_ranks(mesh, k, units, n);
            CHECK(other.labels == found.labels);
            CHECK(other.cut.remarks == found.cut.remarks);
        }
    }
    // Fewer parts than there are blocks.
    const PolygonMesh mesh = test::triangle_torus(40, 30);
    const FoundCut halves = cut_by_ranks(mesh, 2, {.faces_of_chunk = 200, .chunks_of_block = 1}, 3);
    check_sound(mesh, halves);
    CHECK(halves.cut.n_parts == 2);
    CHECK(largest_part(halves.labels, 2) < 0.6 * mesh.n_faces());
}

TEST_CASE("what is not manifold is cut alike by any number of ranks, and every part is sound")
{
    const PolygonMesh fins = with_fins(test::triangle_torus(40, 30));
    for (const Index chunk : {150, 700}) {
        CAPTURE(chunk);
        const FoundCut found = cut_by_ranks(fins, 16, {.faces_of_chunk = chunk}, 1);
        check_sound(fins, found);
        for (const int n : {2, 5})
            CHECK(cut_by_ranks(fins, 16, {.faces_of_chunk = chunk}, n).labels == found.labels);
    }
    for (const test::NamedMesh& example : test::assorted_meshes()) {
        const PolygonMesh& mesh = example.mesh;
        CAPTURE(example.name);
        const FoundCut found = cut_by_ranks(mesh, 3, {.faces_of_chunk = 5}, 1);
        check_sound(mesh, found);
        CHECK(cut_by_ranks(mesh, 3, {.faces_of_chunk = 5}, 3).labels == found.labels);
    }
}

TEST_CASE("faces that repeat others are left out of the cut, and have the labels of those that they repeat")
{
    const PolygonMesh single = make_mixed_polygons(900);
    PolygonMesh mesh = single;
    // Every third face once more, turned round and beginning at another corner.
    std::vector<Index> repeats;
    for (Index f = 0; f < single.n_faces(); f += 3) {
        std::vector<Index> corners(single.face(f).rbegin(), single.face(f).rend());
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        mesh.add_face(corners);
        repeats.push_back(f);
    }
    const std::vector<Index> given = test::random_labels(mesh.n_faces(), 4, 3);
    for (const Index chunk : {100, 10'000}) {
        const FoundCut of_single = cut_by_ranks(single, 9, {.faces_of_chunk = chunk}, 2);
        const FoundCut by_labels =
            cut_by_ranks(single, 9, {.faces_of_chunk = chunk}, 2, {given.begin(), given.begin() + single.n_faces()});
        for (const int n : {1, 3}) {
            CAPTURE(chunk);
            CAPTURE(n);
            const auto check = [&](const FoundCut& found, const FoundCut& expected) {
                REQUIRE(found.labels.size() == at(mesh.n_faces()));
                CHECK(std::equal(expected.labels.begin(), expected.labels.end(), found.labels.begin()));
                for (std::size_t i = 0; i < repeats.size(); ++i)
                    CHECK(found.labels[expected.labels.size() + i] == found.labels[repeats[i]]);
            };
            check(cut_by_ranks(mesh, 9, {.faces_of_chunk = chunk}, n), of_single);
            check(cut_by_ranks(mesh, 9, {.faces_of_chunk = chunk}, n, given), by_labels);
        }
    }
}

TEST_CASE("seams are joined as on one machine, and what was joined comes back to its vertices")
{
    const PolygonMesh whole = make_mixed_polygons(900);
    std::vector<Index> halves;
    for (Index f = 0; f < whole.n_faces(); ++f)
        halves.push_back(whole.vertices.row(whole.face(f).front())[0] < 0.5 ? 0 : 1);
    PolygonMesh mesh = test::split(whole, halves);
    // Not quite at equal places.
    for (Index v = 0; v < mesh.n_vertices(); v += 7)
        mesh.vertices(v, 2) += 1e-9;
    const double distance = 1e-6;
    const Topology topology = make_topology(mesh);
    const auto expected = weld(mesh, topology, distance);
    REQUIRE(expected);
    for (const Index chunk : {200, 10'000})
        for (const int n : {1, 4}) {
            CAPTURE(chunk);
            CAPTURE(n);
            FlowOptions options;
            options.cut.subdomains = 6;
            options.motion.weld = distance;
            options.resources.threads = 1;
            run_on_threads(n, [&](Transport& transport) {
                run_together(transport, [&](Communicator& comm) {
                    const std::vector<Index> labels(mesh.n_faces(), 0);
                    RankSlice slice = test::slice_of(mesh, labels, comm.rank(), n);
                    const Points before = slice.vertices;
                    const DistributedCut cut = cut_together(comm, slice, options, {.faces_of_chunk = chunk});
                    REQUIRE(cut.remarks.size() == 1);
                    CHECK(cut.remarks.front() ==
                          remark_on_seams(expected->n_vertices, expected->n_edges, mesh.n_vertices(), distance));
                    const RankSlice joined = test::slice_of(expected->mesh, labels, comm.rank(), n);
                    CHECK(slice.corners == joined.corners);
                    bring_back(comm, cut.seams, slice);
                    CHECK(test::same_bits(slice.vertices, before));
                    // As if the flow had moved what has faces, by as much everywhere.
                    Points moved = joined.vertices;
                    moved.rowwise() += Point(1.0, 2.0, 4.0);
                    slice.vertices = moved;
                    bring_back(comm, cut.seams, slice);
                    const Index begin = static_cast<Index>(std::int64_t{mesh.n_vertices()} * comm.rank() / n);
                    for (Index v = 0; v < static_cast<Index>(moved.rows()); ++v) {
                        const Point expected_place =
                            expected->mesh.vertices.row(expected->first[begin + v]) + Point(1.0, 2.0, 4.0);
                        CHECK(Point(slice.vertices.row(v)) == expected_place);
                    }
                });
            });
        }
}

TEST_CASE("labels without any sense are mended alike by any number of ranks")
{
    for (const PolygonMesh& mesh :
         {test::triangle_torus(30, 24), make_mixed_polygons(700), test::moebius_band(80, 6)}) {
        const std::vector<Index> given = test::random_labels(mesh.n_faces(), 12, 3);
        const FoundCut found = cut_by_ranks(mesh, 0, {.faces_of_chunk = 200}, 1, given);
        check_sound(mesh, found);
        CHECK(cut_by_ranks(mesh, 0, {.faces_of_chunk = 200}, 4, given).labels == found.labels);
    }
}

TEST_CASE("labels of any kind are mended alike by any number of ranks")
{
    for (const auto& example : examples()) {
        const PolygonMesh& mesh = example.second;
        CAPTURE(example.first);
        // Stripes across the order of the faces, with single faces strewn in and gaps in their numbers.
        std::vector<Index> given(mesh.n_faces());
        const std::vector<Index> strewn = test::random_labels(mesh.n_faces(), 40, 7);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            given[f] = 3 * (f / (mesh.n_faces() / 9)) + (strewn[f] == 0 ? 5 : 0);
        const FoundCut found = cut_by_ranks(mesh, 0, {.faces_of_chunk = 500}, 1, given);
        check_sound(mesh, found);
        CHECK(found.cut.repaired_faces > 0);
        CHECK(found.cut.remarks.size() >= 2);
        for (const int n : {2, 5}) {
            CAPTURE(n);
            const FoundCut other = cut_by_ranks(mesh, 0, {.faces_of_chunk = 500}, n, given);
            CHECK(other.labels == found.labels);
            CHECK(other.cut.remarks == found.cut.remarks);
        }
        // What is sound stays as it is.
        const FoundCut again = cut_by_ranks(mesh, 0, {.faces_of_chunk = 500}, 3, found.labels);
        CHECK(again.labels == found.labels);
        CHECK(again.cut.repaired_faces == 0);
    }
}
