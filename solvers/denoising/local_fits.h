#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Local quadratic regression on a surface: around each vertex, a polynomial for the heights over the tangent plane is
/// fitted to the nearest vertices, with weights that fall to 0 at the last of them (Cleveland, Devlin, Locally weighted
/// regression, 1988; Levin, Mesh-independent surface interpolation, 2003). Unlike a mean, a fit follows curvature, and
/// at a rim, where all neighbours are on one side, it does not shrink the surface. Vertices across an edge or a thin
/// wall count less, because their normals differ (Öztireli, Guennebaud, Gross, Feature preserving point set surfaces
/// based on non-linear kernel regression, 2009). Bits do not depend on how loops are run.
class LocalFits {
  public:
    /// @param neighbours per vertex, along edges. @param positions #V by 3. @param normals #V by 3: of length 1; where
    /// they are 0, nothing is fitted. All of these must outlive the object.
    LocalFits(const IndexLists& neighbours, const Points& positions, const Points& normals)
        : neighbours_(&neighbours)
        , positions_(&positions)
        , normals_(&normals)
    {
    }

    using Heights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// #V by number of radii: the heights of the fits above the vertices, in length; 0 where there are too few
    /// vertices, or no normal.
    /// @param radii ascending, in edges of a regular mesh: a fit has as many vertices as a regular mesh has within the
    /// radius.
    [[nodiscard]] Heights heights(std::span<const double> radii, const Executor& exec = run_serially) const;

    /// #V: the heights of fits with a radius of its own for each vertex, as in `heights`. @param radii #V.
    [[nodiscard]] std::vector<double> heights_within(std::span<const double> radii,
                                                     const Executor& exec = run_serially) const;

    /// The number of vertices of a regular mesh of triangles within a radius, in edges.
    static std::size_t n_within(double radius);

    /// A fit on a flat regular mesh of triangles: the positions of its vertices relative to the first, which is the
    /// middle, and the weight of each vertex's height in the fitted height at the middle.
    struct Kernel {
        std::vector<Eigen::Vector2d> offsets;
        std::vector<double> weights;
    };

    /// @param radius in edges.
    static Kernel kernel(double radius);

  private:
    const IndexLists* neighbours_;
    const Points* positions_;
    const Points* normals_;
};

}  // namespace seamflow
