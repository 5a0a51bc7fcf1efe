#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A surface in which components that touch, such as closed segments that each have their own copy of the wall between
/// them, share vertices.
struct JoinedCopies {
    /// Its vertices have the numbers of those of the surface; copies have no faces. Faces that are the same now are
    /// there once.
    PolygonMesh mesh;
    /// The same with all faces, in the order of those of the surface.
    PolygonMesh all_faces;
    /// #V: the vertex of which each one is a copy; its own number for others.
    std::vector<Index> original_of;
    /// Ascending: vertices that were not joined, because one component has several vertices at their place. Which of
    /// these are copies of each other cannot be known.
    std::vector<Index> ambiguous;

    /// #V: 1 at vertices that have copies, at copies, and at ambiguous vertices.
    [[nodiscard]] std::vector<std::uint8_t> shared_vertices() const;
};

/// Joins vertices of different components at the same place that are ends of edges of both components with the same two
/// places. Walls that are cut into other faces on their two sides are not joined. Where a component has several
/// vertices at a place, none are joined: they are ambiguous.
/// @param topology with twins. @param components of the faces. @param positions #V by 3.
/// @returns nothing if there are neither copies nor ambiguous vertices.
std::optional<JoinedCopies> join_copies(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                                        const Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
