#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/metrics/coordinate_steps.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// How far the vertices of a surface with rounded coordinates may be from their true places.
struct CoordinateBounds {
    /// The kind of the surface, which says where the true places are.
    enum class Kind {
        /// No coordinate has steps.
        None,
        /// Each coordinate lies within half a step of the true one: faces of voxels.
        Any,
        /// Heights over a plane: one coordinate is rounded, and the two others are exact, because no two vertices have
        /// the same values of both, and no part of the surface is above another.
        Heights,
        /// The surface of marching cubes in a mask: each vertex is in the middle of an edge of the lattice of voxels,
        /// which the true surface crosses somewhere else.
        MarchingCubes,
    };
    Kind kind = Kind::None;
    /// The step of each coordinate, in units of length: the distance of planes through centres of voxels. 0: it is not
    /// rounded.
    Point steps = Point::Zero();
    /// #V by 3: the largest difference of each coordinate from its present value, at least 0.
    Points half_widths = Points(0, 3);
    /// The largest distance of a vertex from its present position.
    double furthest = std::numeric_limits<double>::infinity();
    /// #V: bit k is 1 where the surface is flat across axis k (see flat_facets); empty: nowhere. Half-widths there are
    /// as elsewhere.
    std::vector<std::uint8_t> flat = {};
    /// The mean length of edges.
    double edge = 0.0;
};

/// How large a surface and its edges are.
struct SurfaceSize {
    /// The mean length of edges.
    double edge = 0.0;
    /// The areas of all faces as seen along x, y and z, in length², without those in the lowest and the highest plane
    /// across it, which heights may stand on.
    Point seen = Point::Zero();
};

/// Measures some faces of a surface.
/// @param points #V by 3. @param counts whether a vertex counts: faces do with all their vertices.
SurfaceSize size_of(const PolygonMesh& mesh, const Points& points, const std::function<bool(Index)>& counts,
                    const Executor& exec = run_serially);

/// See size_of. @param counts empty: all vertices do.
using SizeOfParts = std::function<SurfaceSize(const std::function<bool(Index)>& counts)>;

/// Whether x, y and z have steps of about the same size.
bool has_equal_steps(const Point& steps);

/// Finds the steps of a surface, and the bounds of its vertices. A vertex without neighbours gets half-width 0. So does
/// a coordinate that lies on no plane, if those of all neighbours lie on none either: it was not rounded. Of several
/// parts, some may have been rounded and others not: the steps are those that most vertices have, of all parts or of
/// one of the largest, and the vertices of parts that do not have them get half-width 0.
/// @param points #V by 3. @param neighbours #V: the vertices that share an edge with each. @param part_of #V: the part
/// of each vertex, from 0, -1 without faces; empty: there is one part. @param size_of_parts returns the size of the
/// faces whose vertices count: steps below a tenth of their edges cannot be seen, of heights below a hundredth, and do
/// not count.
CoordinateBounds bounds_of(const Points& points, const IndexLists& neighbours, std::span<const Index> part_of,
                           const SizeOfParts& size_of_parts, const Executor& exec = run_serially);

/// The bounds for steps that are known: those that are found if they have these steps, or are heights with this step;
/// otherwise half a step for each coordinate. They count on all parts. @param steps of x, y and z, at least 0.
CoordinateBounds bounds_of(const Points& points, const IndexLists& neighbours, const SizeOfParts& size_of_parts,
                           const Point& steps, const Executor& exec = run_serially);

}  // namespace seamflow
