#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/topology.h"

namespace seamflow {

/// The faces around each face, which share a vertex with it. At a vertex of more than most_at_vertex faces, such as the
/// pole of a globe, only most_at_vertex faces count, evenly spaced around the vertex, so that they are on all sides of
/// it. Together with faces that share an edge there are at most most_at_vertex + 2 neighbours per corner.
struct FaceNeighbours {
    static constexpr std::size_t most_at_vertex = 24;

    /// #F + 1: the beginning of each face's neighbours in `faces`.
    std::vector<std::size_t> offsets;
    /// Per face: its neighbours, ascending, distinct, without the face itself.
    std::vector<Index> faces;

    [[nodiscard]] std::span<const Index> operator[](Index f) const
    {
        return std::span<const Index>(faces).subspan(offsets[f], offsets[f + 1] - offsets[f]);
    }
};

/// Which faces that share a vertex are neighbours.
enum class Sheets : std::uint8_t {
    /// All of them.
    All,
    /// Those of the same fan: no face of another sheet, where several meet, and none of another body that touches.
    Own,
};

/// The neighbours of all faces.
/// @param topology with twins.
FaceNeighbours make_face_neighbours(const PolygonMesh& mesh, const Topology& topology,
                                    const Executor& exec = run_serially, Sheets sheets = Sheets::All);

/// 1 or -1 per face: vector areas times these signs point to the same side wherever faces share an edge; on a one-sided
/// surface, not everywhere. Empty if vector areas already do so.
/// @param topology with twins.
std::vector<std::int8_t> face_signs(const PolygonMesh& mesh, const Topology& topology);

}  // namespace seamflow
