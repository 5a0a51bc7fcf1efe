#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The bodies of a surface: its components, connected by shared vertices, numbered by their lowest vertices.
struct SurfaceComponents {
    /// #V: -1 for vertices without faces.
    std::vector<Index> of_vertex;
    /// Per component, ascending.
    IndexLists faces;

    [[nodiscard]] Index count() const { return faces.size(); }

    /// Per component, ascending.
    [[nodiscard]] IndexLists vertices() const;
};

/// @pre every vertex named by a face exists.
SurfaceComponents surface_components(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The same, or nothing where all vertices are in one: that is found sooner than listed.
SurfaceComponents surface_components_if_several(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// Of the boxes around the components, in length: the size of what a surface consists of, however far apart that is. 0
/// without faces.
double largest_diagonal(const PolygonMesh& mesh, const Executor& exec = run_serially);

}  // namespace seamflow
