#pragma once

#include <vector>

#include "partition/connected_components.h"
#include "partition/index_lists.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"

namespace seamflow {

/// Keeps the volumes that the components of a surface enclose: smoothing takes from what is outside and thin, while
/// rounding takes as often as it adds.
class KeptVolumes {
  public:
    /// @param mesh, topology with twins, components of its faces; all must outlive the object. @param positions #V by
    /// 3: those with the volumes that are kept.
    KeptVolumes(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                const Points& positions, const Executor& exec);

    /// From now on, copies of a vertex move together: restore moves them by the mean of the motions that their
    /// components would give them. @param original_of #V: the vertex of which each one is a copy; its own number for
    /// others.
    void share(const std::vector<Index>& original_of);

    /// Moves the vertices of each component along their normals, all by the same length, as far as their boxes allow,
    /// so that the volume comes nearer to that which is kept. Components that enclose no volume stay.
    void restore(const Boxes& boxes, Points& positions, const Executor& exec) const;

  private:
    /// Calls body(component, executor for loops over its faces) for each component.
    template <class Body>
    void for_each_component(const Executor& exec, Body&& body) const;

    [[nodiscard]] double volume(Index component, const Points& positions, const Executor& exec) const;

    const PolygonMesh& mesh_;
    VertexNormals normals_;
    const Components& components_;
    /// Per component: the volume that is kept; 0 for components that enclose none.
    std::vector<double> kept_;
    /// #V: the component of the faces of each vertex; -1 at vertices without faces, and where several components meet.
    std::vector<Index> component_of_;
    /// #V: the copies of each vertex, with itself; nothing at copies. Empty: there are no copies.
    IndexLists copies_;
};

}  // namespace seamflow
