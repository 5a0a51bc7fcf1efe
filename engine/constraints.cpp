#include "engine/constraints.h"

#include "engine/parallel_loop.h"
#include "partition/decomposition/local_mesh.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

bool moves_on_boundary(const Topology& topology, Index v)
{
    return topology.kind[at(v)] == VertexKind::Boundary && topology.moves(v);
}

}  // namespace

Topology make_constrained_topology(const PolygonMesh& mesh, const FlowOptions& options, const Loop& loop)
{
    Topology topology = make_topology(mesh, loop);
    if (options.boundary == Boundary::Free)
        free_boundary(topology);
    hold(topology, options.fixed_vertices);
    return topology;
}

bool boundary_moves(const PolygonMesh& mesh, const Topology& topology)
{
    return !select(run_in_parallel, mesh.n_vertices(), [&](Index v) { return moves_on_boundary(topology, v); }).empty();
}

void require_boundary_unshared(const PolygonMesh& mesh, const Topology& topology, const Cut& cut)
{
    const auto shared = select(run_in_parallel, mesh.n_vertices(), [&](Index v) {
        return moves_on_boundary(topology, v) && is_on_interface(topology, cut.labels, v);
    });
    if (!shared.empty())
        throw OptionError("boundary is free and shared by several sub-meshes, which need converged steps: leave out "
                          "what speaks of sweeps (conditions, sweep, p, …), or use one sub-mesh");
}

}  // namespace seamflow
