#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/formats/gltf_accessors.h"
#include "partition/formats/gltf_content.h"
#include "partition/index.h"

namespace seamflow {

/// Vectors of three floats in a buffer, in the order of the buffer. Several accessors may use them.
struct GltfVectors {
    GltfSpan span;
    /// The name of their first use in the file, for messages.
    std::string name;
    /// The number of the first vector among all vectors.
    Index first = 0;
};

/// Runs body(list, i, number) for all vectors of some lists: i is the index within the list, number the index among the
/// n vectors of all lists.
template <class Body>
void for_each_vector(const std::vector<GltfVectors>& lists, Index n, const Executor& exec, Body&& body)
{
    for_each_block(exec, n, [&](Index, Index begin, Index end) {
        auto list = std::ranges::upper_bound(lists, begin, {}, &GltfVectors::first) - 1;
        for (Index number = begin; number < end; ++number) {
            while (usize(number - list->first) >= list->span.count)
                ++list;
            body(*list, usize(number - list->first), number);
        }
    });
}

/// A primitive of a file, which consists of triangles.
struct GltfPrimitive {
    enum class Mode { Triangles = 4, Strip = 5, Fan = 6 };

    Mode mode = Mode::Triangles;
    /// The number of its first vertex, and the number of its vertices.
    Index first_vertex = 0;
    Index n_vertices = 0;
    /// The indices; nothing: they are 0, 1, 2, …
    std::optional<GltfSpan> indices;
    /// The name of the indices, or of the positions if there are none, for messages.
    std::string name;
    /// The number of faces of all earlier primitives.
    std::int64_t first_face = 0;
    std::int64_t n_faces = 0;
};

/// The surface in a file (see read_gltf).
struct GltfGeometry {
    /// The vectors of positions, in the order in which primitives first use them.
    std::vector<GltfVectors> positions;
    Index n_vertices = 0;
    /// The primitives, each once.
    std::vector<GltfPrimitive> primitives;
    std::int64_t n_faces = 0;
    std::vector<GltfVectors> normals;
    /// For each normal, its vertex; -1 if it belongs to several.
    std::vector<Index> vertex_of_normal;
    /// The sparse accessors of positions, normals and indices.
    std::vector<GltfSparse> sparse;
    /// Whether a primitive has normals that are not updated: they are not floats, not one for each vertex, have no
    /// data, or are the positions themselves.
    bool has_other_normals = false;
    bool has_tangents = false;
    bool has_morph_targets = false;
};

/// Finds the surface. Checks that all of it is within the buffers, and that data that are written do not overlap with
/// other data of the surface.
/// @param content gets buffers for sparse accessors.
/// @throws InputError naming the element.
GltfGeometry geometry_of(GltfContent& content);

}  // namespace seamflow
