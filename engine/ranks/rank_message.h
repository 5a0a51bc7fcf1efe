#pragma once

#include <cstdint>

#include "engine/measure/flow_report.h"
#include "engine/ranks/packing.h"
#include "partition/index.h"

/// The messages of rank 0 to the others, and what they answer.
namespace seamflow {

/// What rank 0 asks all ranks for. Rows of positions belong to the vertices that the rank
/// knows, or in answers to those that it sends (DealtMesh::is_sent).
enum class RankTask : std::uint8_t {
    /// Make a RankPart of a DealtMesh. Answer: the SavedRow of each row that the stepper saves.
    Deal,
    Step,
    /// Answer: rows, one for each vertex whose position comes from here.
    Positions,
    /// Rows of all vertices: Stepper::set_positions, and Stepper::set_data, with its DataSteps.
    SetPositions,
    SetData,
    /// Numbers of vertices, and rows: Stepper::set_vertices.
    SetVertices,
    /// Stepper::save. Answer: numbers and arrays.
    Save,
    /// Rows of all vertices, numbers, and arrays: Stepper::restore.
    Restore,
    /// Answer: a RankShare, and a SubMeshReport of each sub-mesh.
    Describe,
    /// Forget the flow.
    Drop,
    /// End, with an exit status.
    Dismiss,
};

/// What each message of rank 0 begins with.
struct RankHeader {
    RankTask task = RankTask::Dismiss;
    /// Which flow it is about.
    std::int32_t flow = -1;
    /// Of Deal: the number of threads, 0 if it is left open; of Dismiss: the exit status.
    std::int32_t value = 0;
};

/// A message that begins so.
inline Packer rank_message(const RankHeader& header)
{
    Packer message;
    message.put(header);
    return message;
}

/// A row that a stepper saves: its vertex, and the lowest of the sub-meshes there, as in the whole mesh. All rows of a
/// stepper that has the whole mesh are in this order.
struct SavedRow {
    Index lowest;
    Index vertex;

    friend auto operator<=>(const SavedRow&, const SavedRow&) = default;
};

/// What a rank reports as a whole.
struct RankShare {
    RankRecord record;
    ResourceReport resources;
    PhaseSeconds seconds;
    std::int64_t n_interface_vertices;
};

}  // namespace seamflow
