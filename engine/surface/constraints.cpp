#include "engine/surface/constraints.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "engine/measure/remarks.h"
#include "partition/errors.h"
#include "solvers/laplacian/degenerate.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// Refuses a mesh that is not manifold, for MotionOptions::strict.
void require_manifold(const Topology& topology)
{
    const auto found = std::find(topology.kind.begin(), topology.kind.end(), VertexKind::NonManifold);
    if (found != topology.kind.end())
        throw InputError(fmt::format(
            "the mesh is not manifold at vertex {} (numbered from 0): three faces or more share an edge there, or "
            "several fans of faces meet; mend it, or leave strict out",
            found - topology.kind.begin()));
}

/// Fixes vertices without strength.
void hold_still(Topology& topology, const PolygonMesh& mesh, const std::vector<double>& strength,
                std::vector<Remark>& remarks)
{
    if (strength.empty())
        return;
    if (strength.size() != usize(mesh.n_vertices()))
        throw InputError(fmt::format("there are {} strengths, but the mesh has {} vertices: give one for each",
                                     strength.size(), mesh.n_vertices()));
    const auto is_still = [](double s) { return s < MotionOptions::least_strength; };
    for (std::size_t v = 0; v < strength.size(); ++v)
        if (is_still(strength[v]))
            topology.fixed[v] = 1;
    if (std::ranges::all_of(strength, is_still))
        remarks.push_back(
            {"empty region", {}, {"The region is empty: no vertex has a strength above 0, and nothing moves."}});
}

}  // namespace

void constrain(Topology& topology, const PolygonMesh& mesh, const MotionOptions& motion, Laplacian laplacian,
               bool has_lengths, const Executor& exec, std::vector<Remark>& remarks)
{
    if (motion.strict) {
        require_manifold(topology);
        require_sizes(mesh, exec);
    }
    if (motion.junctions == Junctions::Flow)
        free_junctions(mesh, topology, exec);
    if (motion.boundary != Boundary::Fixed)
        free_boundary(topology);
    fix_vertices(topology, motion.fixed_vertices);
    const std::size_t n_weights = motion.attachment_weights.size();
    if (n_weights > 0 && n_weights != usize(mesh.n_vertices()))
        throw InputError(fmt::format("there are {} attachment weights, but the mesh has {} vertices: give one for each",
                                     n_weights, mesh.n_vertices()));
    hold_still(topology, mesh, motion.strength, remarks);
    const bool is_sound = has_lengths && traits_of(laplacian).divisor == Divisor::EdgeLengths;
    const std::vector<Index> undefined =
        is_sound ? std::vector<Index>() : vertices_without_row(mesh, topology, laplacian, exec);
    // If no vertex can move, the reason is reported, which is more useful than the unchanged mesh.
    if (!is_sound && std::ssize(undefined) == std::ranges::count(topology.fixed, 0))
        require_sound_geometry(mesh, topology, laplacian, exec);
    if (!undefined.empty())
        remarks.push_back(
            remark_on_undefined_vertices(static_cast<std::int64_t>(undefined.size()), undefined.front(), laplacian));
    fix_vertices(topology, undefined);
}

}  // namespace seamflow
