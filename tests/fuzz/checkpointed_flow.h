#pragma once

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow::test {

/// A flow of a few steps on a few faces in two sub-meshes, of which checkpoints are tried.
struct CheckpointedFlow {
    CheckpointedFlow();

    /// Three by three squares.
    PolygonMesh mesh;
    FlowOptions options;
};

}  // namespace seamflow::test
