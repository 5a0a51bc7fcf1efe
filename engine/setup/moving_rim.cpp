#include "engine/setup/moving_rim.h"

#include <algorithm>

#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/local_mesh.h"
#include "partition/errors.h"

namespace seamflow {

std::vector<Index> moving_rim(const PolygonMesh& mesh, const Topology& topology)
{
    return select(run_in_parallel, mesh.n_vertices(),
                  [&](Index v) { return topology.kind[v] != VertexKind::Interior && topology.moves(v); });
}

void require_boundary_unshared(const Topology& topology, std::span<const Index> labels, std::span<const Index> vertices)
{
    if (std::ranges::any_of(vertices, [&](Index v) { return is_on_interface(topology, labels, v); }))
        throw OptionError(
            Wording{"<boundary> is free and shared by several sub-meshes, which need converged steps: leave "
                    "out the conditions and parameters of sweeps, or use one sub-mesh"});
}

}  // namespace seamflow
