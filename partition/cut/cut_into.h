#pragma once

#include <functional>
#include <span>

#include "partition/cut/cut.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Runs the serial part of a cut. A caller that has more threads, and work that does not need the cut, can do that work
/// at the same time.
using Alongside = std::function<void(const std::function<void()>& serial)>;

/// Runs `serial` in the thread of the caller.
inline void run_alone(const std::function<void()>& serial)
{
    serial();
}

/// Cuts a mesh into k parts of about equal numbers of unknowns with short interfaces. k = 1: all faces have label 0,
/// even where the mesh has several connected components. k > 1: every part lies within one component, so that there are
/// at least as many parts as components; there may be fewer than k on a small mesh. A remark reports a number of parts
/// other than k.
/// @param alongside called once with METIS's part of the work, if there is any.
/// @throws OptionError if k < 1, ComputationError if METIS fails.
Cut cut_into(const PolygonMesh& mesh, const Topology& topology, Index k, const Executor& exec = run_serially,
             const Alongside& alongside = run_alone);

/// Cuts a mesh by labels. Gaps in the labels are closed, keeping their order, and parts that are not manifolds with
/// boundary are repaired (see repair); remarks report both. If all labels are equal, the mesh is not cut.
/// @param labels #F, at least 0.
/// @throws InputError if there are not as many labels as faces, or one is negative.
Cut cut_by_labels(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                  const Executor& exec = run_serially);

}  // namespace seamflow
