#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/distributed/ranks/communicator.h"
#include "engine/measure/bounding_box.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The part of a mesh that a rank knows. In a whole mesh, vertices, faces and sub-meshes have numbers that all ranks
/// agree on; the part has its own, in the same order.
struct MeshPart {
    PolygonMesh mesh;
    /// #V and #F, ascending: the numbers in the whole mesh.
    std::vector<std::int64_t> vertex_numbers;
    std::vector<std::int64_t> face_numbers;
    /// #F: the sub-mesh of every face, numbered in the whole mesh, at least 0. All faces of a sub-mesh belong to one
    /// rank.
    std::vector<Index> labels;
    /// #V: 1 where a vertex stays where it is, as MotionOptions::fixed_vertices do. Empty: nowhere.
    std::vector<std::uint8_t> fixed = {};
    /// #V: weights of the attachment, as MotionOptions::attachment_weights. Empty on all ranks: there are none.
    std::vector<double> attachment_weights = {};
    /// #V: the strength of each step, as MotionOptions::strength. Empty on all ranks: 1 everywhere.
    std::vector<double> strengths = {};
    /// The box around all faces of the whole mesh, where the parts do not have all of them. It decides where a mesh
    /// flows that lies far from the origin.
    std::optional<BoundingBox> box = {};
};

/// Checks that the arrays fit together and that numbers ascend.
/// @throws InputError naming the first vertex or face (in the whole mesh, where it has a number) at which they do not.
void require_valid(const MeshPart& part);

/// Some faces of a part and their vertices, in the order of the part.
/// @param faces as indices into the part, ascending.
MeshPart some_faces(const MeshPart& part, std::span<const Index> faces);

/// The part with `layers` layers of other ranks' faces around it: a layer is all faces around the vertices of those
/// already there. All ranks call this together.
/// @param own the faces that are the rank's own: every face of the mesh is that of one rank.
MeshPart grown_by_layers(Communicator& comm, const MeshPart& own, int layers);

}  // namespace seamflow
