#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Finds vertices with a coordinate that stands for missing data, such as -9999 where a height is not known: those that
/// have the smallest or the largest value of a coordinate, or one of the two smallest or largest, if these are away
/// from all other values by several times their range, and fewer than half of the vertices have them.
/// @param positions #V by 3. @param spikes see find_spikes; those without others beside them do not count, and leave no
/// gap.
/// @returns #V: 1 at these vertices; empty: there are none.
std::vector<std::uint8_t> vertices_without_data(const PolygonMesh& mesh, const Points& positions,
                                                std::span<const Spike> spikes);

/// The faces of a surface all of whose vertices have data.
struct KnownSurface {
    /// It has all vertices of the surface.
    PolygonMesh mesh;
    /// Vertices that the surface fixes are fixed. Where the surface has junctions, those of this one move.
    Topology topology;
    /// Its faces in the surface, ascending.
    std::vector<Index> faces;

    /// @param of_surface with twins. @param is_missing see vertices_without_data; not empty.
    KnownSurface(const PolygonMesh& surface, const Topology& of_surface, const std::vector<std::uint8_t>& is_missing,
                 const Executor& exec = run_serially);

    /// Flags of all faces of the surface: those beside missing data go with the known faces around them, and are 0 if
    /// one of these is.
    /// @param of_known those of the known faces.
    [[nodiscard]] std::vector<std::uint8_t> of_all_faces(const PolygonMesh& surface,
                                                         const std::vector<std::uint8_t>& of_known) const;
};

}  // namespace seamflow
