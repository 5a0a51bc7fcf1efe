#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Distances along a surface from any of its vertices, by the heat method (Crane, Weischedel and Wardetzky, Geodesics
/// in Heat, 2013), for any polygons: heat diffuses from the sources for a short time, and the distance is the function
/// whose gradient is nearest to the unit vectors along which the heat decreases. The Laplacian is that of virtual
/// vertices (Δ_B, VirtualRefinement). On good meshes the error is a fraction of an edge length; it is larger where an
/// edge is long or a triangle has a very obtuse angle. The two factorisations of the whole mesh, or three if it has a
/// boundary, are kept for further distances; sources on the boundary need a further one each time.
class Geodesics {
  public:
    /// @param mesh is copied. Vertices along seams (see weld) are joined; faces that repeat others are left out.
    /// @param resources threads.
    /// @throws InputError for a mesh that cannot be used; as mean_curvature_flow.
    explicit Geodesics(const PolygonMesh& mesh, const ResourceOptions& resources = {});
    ~Geodesics();
    Geodesics(const Geodesics&) = delete;
    Geodesics& operator=(const Geodesics&) = delete;

    /// The distances from the nearest of some vertices.
    /// @param from the sources, in any order.
    /// @returns #V: in length; 0 for the sources, infinite where the surface is not connected with a source.
    /// @throws InputError for no sources, for sources that do not exist, and for distances beyond the largest number;
    ///         naming a vertex, if the lengths of edges differ too much; as mean_curvature_flow.
    Eigen::VectorXd distance(std::span<const Index> from, const FlowControl& control = {});

  private:
    class Surface;
    ResourceOptions resources_;
    std::unique_ptr<Surface> surface_;
};

/// The distances from the nearest of some vertices, once (see Geodesics).
Eigen::VectorXd geodesic_distance(const PolygonMesh& mesh, std::span<const Index> from,
                                  const ResourceOptions& resources = {}, const FlowControl& control = {});

}  // namespace seamflow
