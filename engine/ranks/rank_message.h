#pragma once

#include <cstdint>

#include "engine/measure/flow_report.h"
#include "engine/ranks/packing.h"
#include "partition/index.h"

/// The messages of rank 0 to other ranks, and their answers.
namespace seamflow {

/// The requests of rank 0 to all ranks. In requests, rows of positions belong to the vertices that the rank knows; in
/// answers, to the vertices that it sends (DealtMesh::is_sent).
enum class RankTask : std::uint8_t {
    /// Make a RankPart from a DealtMesh. Answer: the SavedRow of each row that the stepper saves.
    Deal,
    Step,
    /// Answer: rows, one for each vertex whose position this rank sends.
    Positions,
    /// Rows of all vertices: Stepper::set_positions, and HeatStepper::set_data, with its DataSteps.
    SetPositions,
    SetData,
    /// Numbers of vertices, and rows: Stepper::set_vertices.
    SetVertices,
    /// Stepper::save. Answer: numbers and arrays.
    Save,
    /// Rows of all vertices, numbers, and arrays: Stepper::restore.
    Restore,
    /// Answer: a RankShare, and a SubMeshReport for each sub-mesh.
    Describe,
    /// Forget the flow.
    Drop,
    /// End with an exit status.
    Dismiss,
};

/// The beginning of each message of rank 0.
struct RankHeader {
    RankTask task = RankTask::Dismiss;
    /// The number of the flow that the request concerns.
    std::int32_t flow = -1;
    /// In Deal: the number of threads, 0 if it is not set. In Dismiss: the exit status.
    std::int32_t value = 0;
};

/// A message that begins with this header.
inline Packer rank_message(const RankHeader& header)
{
    Packer message;
    message.put(header);
    return message;
}

/// A row that a stepper saves: its vertex, and the lowest of the sub-meshes at the vertex, both numbered as in the
/// whole mesh. A stepper that has the whole mesh saves its rows in this order.
struct SavedRow {
    Index lowest;
    Index vertex;

    friend auto operator<=>(const SavedRow&, const SavedRow&) = default;
};

/// The part of a report that concerns a whole rank.
struct RankShare {
    RankRecord record;
    ResourceReport resources;
    PhaseSeconds seconds;
    std::int64_t n_interface_vertices;
};

}  // namespace seamflow
