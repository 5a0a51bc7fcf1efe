#include "solvers/denoising/filter_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

constexpr Index most_vertices = 30'000;
constexpr Index n_patches = 32;
constexpr int patch_rings = 18;
constexpr int measured_rings = 8;
constexpr int outside_patches = patch_rings + 1;

/// #V: the distance in rings of faces to the nearest middle of a patch; `outside_patches` for vertices further away.
std::vector<std::int8_t> rings_around_middles(const PolygonMesh& mesh, const Topology& topology)
{
    const Index n = mesh.n_vertices();
    std::vector<std::int8_t> rings(usize(n), outside_patches);
    std::vector<Index> front;
    for (Index i = 0; i < n_patches; ++i) {
        // The sequence is evenly spread, and has no common period with any grid.
        double whole = 0.0;
        const double place = std::modf((i + 1) * (std::numbers::phi - 1.0), &whole);
        const auto v = static_cast<Index>(place * n);
        rings[v] = 0;
        front.push_back(v);
    }
    for (std::int8_t ring = 1; ring <= patch_rings; ++ring) {
        std::vector<Index> next;
        for (const Index v : front)
            for (const Index corner : topology.corners_at(v))
                for (const Index w : mesh.face(topology.face_of[corner]))
                    if (rings[w] == outside_patches) {
                        rings[w] = ring;
                        next.push_back(w);
                    }
        front = std::move(next);
    }
    return rings;
}

}  // namespace

FilterSample take_filter_sample(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const Index n = mesh.n_vertices();
    const std::vector<std::int8_t> rings =
        n <= most_vertices ? std::vector<std::int8_t>(usize(n), 0) : rings_around_middles(mesh, topology);
    FilterSample sample;
    sample.vertices = select(exec, n, [&](Index v) { return rings[v] < outside_patches; });
    const auto n_vertices = static_cast<Index>(sample.vertices.size());
    std::vector<std::vector<Index>> neighbours(usize(n_vertices));
    for_each(exec, n_vertices, [&](Index i) {
        const Index v = sample.vertices[i];
        if (!topology.moves(v) || rings[v] >= patch_rings)
            return;
        neighbours[i] = neighbours_of(mesh, topology, v);
        for (Index& w : neighbours[i])
            w = place_in(sample.vertices, w);
    });
    for (Index i = 0; i < n_vertices; ++i) {
        sample.neighbours.values.insert(sample.neighbours.values.end(), neighbours[i].begin(), neighbours[i].end());
        sample.neighbours.close();
        if (!neighbours[i].empty() && rings[sample.vertices[i]] <= measured_rings)
            sample.measured.push_back(i);
    }
    return sample;
}

std::vector<Index> faces_of(const FilterSample& sample, const PolygonMesh& mesh, const Executor& exec)
{
    std::vector<std::uint8_t> is_in(usize(mesh.n_vertices()), 0);
    for (const Index v : sample.vertices)
        is_in[v] = 1;
    return select(exec, mesh.n_faces(),
                  [&](Index f) { return std::ranges::all_of(mesh.face(f), [&](Index v) { return is_in[v] != 0; }); });
}

}  // namespace seamflow
