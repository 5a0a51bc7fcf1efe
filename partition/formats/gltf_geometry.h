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

/// Vectors of three floats, known to several accessors, in the order of the buffer.
struct GltfVectors {
    GltfSpan span;
    /// Where the file names them first, for messages.
    std::string name;
    /// The number of its first element among those of all.
    Index first = 0;
};

/// Runs body(list, i, number) for the n elements of some lists.
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

/// Triangles of a file.
struct GltfPrimitive {
    enum class Mode { Triangles = 4, Strip = 5, Fan = 6 };

    Mode mode = Mode::Triangles;
    /// The number of the first vertex, and how many there are.
    Index first_vertex = 0;
    Index n_vertices = 0;
    /// Nothing: they are 0, 1, 2, …
    std::optional<GltfSpan> indices;
    /// Of the indices or else of the positions, for messages.
    std::string name;
    /// Number of faces of those before it.
    std::int64_t first_face = 0;
    std::int64_t n_faces = 0;
};

/// The surface in a file, see read_gltf.
struct GltfGeometry {
    /// In the order in which the primitives name them.
    std::vector<GltfVectors> positions;
    Index n_vertices = 0;
    /// Each once.
    std::vector<GltfPrimitive> primitives;
    std::int64_t n_faces = 0;
    std::vector<GltfVectors> normals;
    /// For each normal its vertex, or -1 if it has several.
    std::vector<Index> vertex_of_normal;
    /// Those among the accessors of all these.
    std::vector<GltfSparse> sparse;
    /// Whether a primitive has normals that are not floats, or are not there once for each vertex.
    bool has_other_normals = false;
    bool has_tangents = false;
    bool has_morph_targets = false;
};

/// Finds the surface, checking that all of it is within the buffers and that nothing which is written there lies upon
/// anything else of it.
/// @param content gets buffers for sparse accessors.
/// @throws InputError naming the element.
GltfGeometry geometry_of(GltfContent& content);

}  // namespace seamflow
