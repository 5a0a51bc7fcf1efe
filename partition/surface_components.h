#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The bodies of a surface: its components, connected by shared vertices, numbered by their lowest vertices.
struct SurfaceComponents {
    /// #V: the component of each vertex; -1 for vertices without faces.
    std::vector<Index> of_vertex;
    /// Per component: its faces, ascending.
    IndexLists faces;

    [[nodiscard]] Index count() const { return faces.size(); }

    /// Per component: its vertices, ascending.
    [[nodiscard]] IndexLists vertices() const;
};

/// Finds the components.
/// @pre every vertex named by a face exists.
SurfaceComponents surface_components(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// Finds the components; returns none (count() is 0) if all vertices are in one component, which is faster than listing
/// its vertices and faces. A vertex without faces is not in that component.
SurfaceComponents surface_components_if_several(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The largest diagonal of the bounding boxes of the components, in length: the size of the bodies, however far apart
/// they are. 0 without faces.
double largest_diagonal(const PolygonMesh& mesh, const Executor& exec = run_serially);

}  // namespace seamflow
