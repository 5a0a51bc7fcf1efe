#include "partition/metrics/feathered.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/metrics/fast_marching.h"
#include "partition/topology.h"
#include "partition/weld.h"

namespace seamflow {

namespace {

/// Whether v has no strength, but another vertex of its faces has.
bool is_on_rim(const PolygonMesh& mesh, const Topology& topology, std::span<const double> strength, Index v)
{
    return !(strength[v] > 0.0) && std::ranges::any_of(topology.corners_at(v), [&](Index corner) {
        return std::ranges::any_of(mesh.face(topology.face_of[corner]), [&](Index w) { return strength[w] > 0.0; });
    });
}

}  // namespace

std::vector<double> feathered(const PolygonMesh& mesh, std::vector<double> strength, double length,
                              std::optional<double> joined_within, const Executor& exec)
{
    if (!(length >= 0.0 && std::isfinite(length)))
        throw OptionError(
            fmt::format("the feather is {:.17g} long, but must be at least 0 and finite (a length)", length));
    if (strength.size() != usize(mesh.n_vertices()))
        throw InputError(fmt::format("there are {} strengths, but the mesh has {} vertices: give one for each",
                                     strength.size(), mesh.n_vertices()));
    if (length == 0.0)
        return strength;
    const Topology topology = make_topology(mesh, exec);
    const std::optional<Weld> welded =
        joined_within ? weld(mesh, topology, *joined_within, exec) : std::optional<Weld>();
    std::vector<Index> representative(strength.size());
    std::iota(representative.begin(), representative.end(), 0);
    if (welded)
        representative = welded->representative;
    for (std::size_t v = 0; v < representative.size(); ++v)
        strength[representative[v]] = std::min(strength[representative[v]], strength[v]);
    const PolygonMesh& joined = welded ? welded->mesh : mesh;
    const Topology& of_joined = welded ? welded->topology : topology;
    const std::vector<Index> rim =
        select(exec, mesh.n_vertices(), [&](Index v) { return is_on_rim(joined, of_joined, strength, v); });
    const std::vector<double> distances = distances_from(joined, of_joined, rim, length);
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double t = std::min(distances[representative[v]] / length, 1.0);
        if (representative[v] == v)
            strength[v] *= t * t * t * (10.0 + t * (6.0 * t - 15.0));
    });
    for (std::size_t v = 0; v < representative.size(); ++v)
        strength[v] = strength[representative[v]];
    return strength;
}

}  // namespace seamflow
