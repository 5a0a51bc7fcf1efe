#pragma once

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"

namespace seamflow {

/// Takes back a part of the motion of vertices beside lines where several sheets meet, points where bodies touch, and
/// sharp edges: while faces cross there that did not, or have turned by more than 90°, their vertices go back towards
/// the fair surface, and if that does not suffice, towards the input. Stairs shrink along a line when it becomes
/// straight, and their faces pass each other. All other vertices keep their positions, and so do those that hundreds of
/// faces share. Faces further from such lines are not looked at. Bits do not depend on how loops are run.
/// @param topology with twins and junctions. @param fair #V by 3: in the boxes. @param boxes their middles are the
/// input.
/// @param positions #V by 3: in the boxes, and afterwards, too.
void uncross_faces(const PolygonMesh& mesh, const Topology& topology, const Points& fair, const Boxes& boxes,
                   Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
