#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The cells that the faces of a mesh enclose: the bounded regions of space between sheets that meet, such as the
/// bubbles of a foam. However faces are oriented, they are found by walking around edges: from the side of a face to
/// the side of the next face that looks at it, and at an edge of one face to its other side. A region with a hole is
/// thus one with what is behind the hole, and no cell if that is the outside.
struct EnclosedCells {
    /// One list for each cell, the largest cell first: the sides of faces around it, 2 f for the side of face f that
    /// its normal points to, and 2 f + 1 for the other. Faces with both sides in one cell are left out.
    IndexLists sides;

    [[nodiscard]] Index count() const { return sides.size(); }
};

/// Finds the cells. Surfaces that lie in a cell without touching the sheets around it are not joined with these: such a
/// cell contains the ones in it. Linear in the size of the mesh, but for sorting at edges of three faces or more.
/// @param positions #V by 3, not necessarily those of the mesh; where sheets cross each other, or lie on
///        each other without being the same faces, cells mean nothing.
EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The volume of each cell in length³, negative for cells turned inside out.
/// @param positions #V by 3, not necessarily those that the cells were found with.
std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec = run_serially);

}  // namespace seamflow
