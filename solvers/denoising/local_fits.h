#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Local quadratic regression on a surface: around each vertex a polynomial of the heights over the tangent plane is
/// fitted to the vertices that are nearest, with weights that fall to 0 at the last of them (Cleveland, Devlin, Locally
/// weighted regression, 1988; Levin, Mesh-independent surface interpolation, 2003). Unlike a mean, a fit follows what
/// bends, and at a rim, where its neighbours are all on one side, it neither shrinks nor lags. What lies across an edge
/// or a thin wall counts less, as its normals differ (Öztireli, Guennebaud, Gross, Feature preserving point set
/// surfaces based on non-linear kernel regression, 2009). Bits do not depend on how loops are run.
class LocalFits {
  public:
    /// @param neighbours per vertex, along edges. @param positions #V by 3. @param normals #V by 3: of length 1, or 0:
    /// nothing is fitted there. All must outlive the object.
    LocalFits(const IndexLists& neighbours, const Points& positions, const Points& normals)
        : neighbours_(&neighbours)
        , positions_(&positions)
        , normals_(&normals)
    {
    }

    using Heights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// #V by number of radii: how far above the vertices the fits are; 0 where there are too few.
    /// @param radii ascending, in edges of a regular mesh: as many vertices are fitted as there are within.
    [[nodiscard]] Heights heights(std::span<const double> radii, const Executor& exec = run_serially) const;

    /// #V: the same with a radius for each vertex.
    [[nodiscard]] std::vector<double> heights_within(std::span<const double> radii,
                                                     const Executor& exec = run_serially) const;

    /// How many vertices of a regular mesh of triangles are within a radius, in edges.
    static std::size_t n_within(double radius);

    /// Vertices of a flat regular mesh of triangles around one of them, which has the first place, and their parts in
    /// the height that is fitted there.
    struct Kernel {
        std::vector<Eigen::Vector2d> places;
        std::vector<double> parts;
    };

    /// @param radius in edges.
    static Kernel kernel(double radius);

  private:
    const IndexLists* neighbours_;
    const Points* positions_;
    const Points* normals_;
};

}  // namespace seamflow
