#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Distances along a surface from any of its vertices, by the heat method (Crane, Weischedel and Wardetzky, Geodesics
/// in Heat, 2013), for any polygons: heat diffuses from vertices for a short time, and the distance is the function
/// whose gradient comes nearest to the directions in which the heat decreases, by length 1. With the Laplacian of
/// virtual vertices (Δ_B). Where an edge is long or a triangle has a very obtuse angle, it is less accurate; on good
/// meshes it is so to about the part of an edge length. The two factorisations of the whole mesh, or three where there
/// is a boundary, are kept for further distances; sources on the boundary need a further one each time.
class Geodesics {
  public:
    /// @param mesh is copied. Vertices along seams (see weld) are joined; faces that repeat others are left out.
    /// @param resources threads.
    /// @throws InputError for a mesh that cannot be used; as mean_curvature_flow.
    explicit Geodesics(const PolygonMesh& mesh, const ResourceOptions& resources = {});
    ~Geodesics();
    Geodesics(const Geodesics&) = delete;
    Geodesics& operator=(const Geodesics&) = delete;

    /// @param from vertices, in any order.
    /// @returns #V: in length; 0 for the vertices themselves, infinite where the surface does not lead from any of
    ///          them.
    /// @throws InputError for no vertices, for those that do not exist, and for distances beyond the largest number;
    ///         naming a vertex, where the lengths of edges differ too much; as mean_curvature_flow.
    Eigen::VectorXd distance(std::span<const Index> from, const FlowControl& control = {});

  private:
    class Surface;
    ResourceOptions resources_;
    std::unique_ptr<Surface> surface_;
};

/// Distances from some vertices alone (see Geodesics).
Eigen::VectorXd geodesic_distance(const PolygonMesh& mesh, std::span<const Index> from,
                                  const ResourceOptions& resources = {}, const FlowControl& control = {});

}  // namespace seamflow
