#include "solvers/rounding/missing_data.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace seamflow {

namespace {

/// How far a value for missing data is from all others, in their ranges.
constexpr double least_gap = 3.0;
/// Different values for missing data, on one side of the others.
constexpr std::size_t most_values = 2;

/// The vertices that faces use, without spikes that have no other spike beside them.
std::vector<Index> used_vertices(const PolygonMesh& mesh, std::span<const Spike> spikes)
{
    std::vector<std::uint8_t> is_spike(usize(mesh.n_vertices()), 0);
    for (const Spike& spike : spikes)
        is_spike[spike.vertex] = 1;
    std::vector<std::uint8_t> is_used(usize(mesh.n_vertices()), 0);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto n_spikes = std::ranges::count_if(mesh.face(f), [&](Index v) { return is_spike[v] != 0; });
        for (const Index v : mesh.face(f))
            if (is_spike[v] == 0 || n_spikes > 1)
                is_used[v] = 1;
    }
    std::vector<Index> used;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_used[v] != 0)
            used.push_back(v);
    return used;
}

/// Finds the vertices with the largest value, or the two largest ones, if these stand for missing data.
/// @param spikes are marked with them, if they have such values. @param value_of the coordinate of a vertex, or its
/// negative. @param is_missing receives 1 at these vertices.
/// @returns whether they do.
template <class ValueOf>
bool mark_largest(const std::vector<Index>& vertices, const std::vector<Index>& spikes, ValueOf&& value_of,
                  std::vector<std::uint8_t>& is_missing)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // The largest values, descending, with the numbers of their vertices.
    std::array<double, most_values + 1> largest{};
    largest.fill(-infinity);
    double smallest = infinity;
    for (const Index v : vertices) {
        double value = value_of(v);
        smallest = std::min(smallest, value);
        for (double& one : largest) {
            if (value == one)
                break;
            if (value > one)
                std::swap(value, one);
        }
    }
    for (std::size_t n = most_values; n > 0; --n) {
        const double range = largest[n] - smallest;
        const double least = largest[n - 1];
        const auto is_beyond = [&](Index v) { return value_of(v) >= least; };
        // What lies in one plane has no range to compare with.
        if (!(range > 0.0) || !(least - largest[n] > least_gap * range) ||
            2 * std::ranges::count_if(vertices, is_beyond) >= std::ssize(vertices))
            continue;
        for (const std::span<const Index> list : {std::span(vertices), std::span(spikes)})
            for (const Index v : list)
                if (is_beyond(v))
                    is_missing[v] = 1;
        return true;
    }
    return false;
}

}  // namespace

std::vector<std::uint8_t> vertices_without_data(const PolygonMesh& mesh, const Points& positions,
                                                std::span<const Spike> spikes)
{
    const std::vector<Index> vertices = used_vertices(mesh, spikes);
    std::vector<Index> of_spikes;
    for (const Spike& spike : spikes)
        of_spikes.push_back(spike.vertex);
    std::vector<std::uint8_t> is_missing(usize(mesh.n_vertices()), 0);
    bool found = false;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            found |= mark_largest(
                vertices, of_spikes, [&](Index v) { return sign * positions(v, axis); }, is_missing);
    return found ? is_missing : std::vector<std::uint8_t>();
}

KnownSurface::KnownSurface(const PolygonMesh& surface, const Topology& of_surface,
                           const std::vector<std::uint8_t>& is_missing, const Executor& exec)
{
    mesh.vertices = surface.vertices;
    for (Index f = 0; f < surface.n_faces(); ++f)
        if (std::ranges::none_of(surface.face(f), [&](Index v) { return is_missing[v] != 0; })) {
            mesh.add_face(surface.face(f));
            faces.push_back(f);
        }
    topology = make_topology(mesh, exec);
    if (!of_surface.junctions.empty())
        free_junctions(mesh, topology, exec);
    topology.fixed = of_surface.fixed;
}

std::vector<std::uint8_t> KnownSurface::of_all_faces(const PolygonMesh& surface,
                                                     const std::vector<std::uint8_t>& of_known) const
{
    std::vector<std::uint8_t> is_zero(usize(surface.n_vertices()), 0);
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (of_known[i] == 0)
            for (const Index v : surface.face(faces[i]))
                is_zero[v] = 1;
    std::vector<std::uint8_t> flags(usize(surface.n_faces()));
    for (Index f = 0; f < surface.n_faces(); ++f)
        flags[f] = std::ranges::any_of(surface.face(f), [&](Index v) { return is_zero[v] != 0; }) ? 0 : 1;
    for (std::size_t i = 0; i < faces.size(); ++i)
        flags[faces[i]] = of_known[i];
    return flags;
}

}  // namespace seamflow
