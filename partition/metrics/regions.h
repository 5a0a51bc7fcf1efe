#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What the faces of a mesh divide space into, found by walking around edges: from the side of a face to the side of
/// the next face that looks at it, and at an edge of one face to its other side. Sides are numbered 2 f for the side of
/// face f that its normal points to, and 2 f + 1 for the other. A region has one surface around it: what a hollow body
/// encloses between its two surfaces is two regions here.
struct Regions {
    /// #2F: the region at each side, numbered by their lowest sides.
    std::vector<Index> of_side;
    /// The sides of each region, ascending, without faces that have it on both sides.
    IndexLists sides;
    /// In length³: positive if the region lies within its surface, negative if it lies around it, 0 if it may be merely
    /// rounding of positions in single precision, as between repeated faces.
    std::vector<double> volumes;
    /// Sides of faces on which the next face around an edge where sheets meet lies. If the two are parts of two sheets
    /// on each other, the region at the side has the volume 0.
    std::vector<Index> contacts;

    [[nodiscard]] Index count() const { return sides.size(); }
};

/// Linear in the size of the mesh, but for sorting at edges of three faces or more.
/// @param positions #V by 3, not necessarily those of the mesh.
Regions find_regions(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The volume that lies on these sides of faces, in length³, for each list.
std::vector<double> volumes_on(const IndexLists& sides, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec = run_serially);

}  // namespace seamflow
