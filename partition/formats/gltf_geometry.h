#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "partition/formats/gltf_content.h"
#include "partition/index.h"

namespace seamflow {

/// Where the elements of an accessor are: `size` bytes each, `stride` apart, from byte `offset` of a buffer on. They
/// are known to be there.
struct GltfSpan {
    std::size_t buffer = 0;
    std::size_t offset = 0;
    std::size_t stride = 0;
    std::size_t size = 0;
    std::size_t count = 0;
    /// As the file numbers types, see below.
    std::uint64_t component = 0;
    std::size_t n_components = 0;

    /// The bytes from the first to the last.
    [[nodiscard]] std::size_t end() const { return offset + (count - 1) * stride + size; }

    friend bool operator==(const GltfSpan&, const GltfSpan&) = default;
};

inline constexpr std::uint64_t gltf_byte = 5121;
inline constexpr std::uint64_t gltf_short = 5123;
inline constexpr std::uint64_t gltf_int = 5125;
inline constexpr std::uint64_t gltf_float = 5126;

/// The elements of an accessor.
/// @throws InputError naming the accessor or the view if it is not within its buffer, or cannot be used: compressed,
///         sparse or without data.
GltfSpan span_of_gltf(const GltfContent& content, const GltfValue& accessor);

/// Vectors of three floats, known to several accessors, in the order of the buffer.
struct GltfVectors {
    GltfSpan span;
    /// Where the file names them first, for messages.
    std::string name;
    /// The number of its first element among those of all.
    Index first = 0;
};

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
    /// Whether a primitive has normals that are not floats, or are not there once for each vertex.
    bool has_other_normals = false;
    bool has_tangents = false;
    bool has_morph_targets = false;
};

/// Finds the surface, checking that all of it is within the buffers and that nothing which is written there lies upon
/// anything else of it.
/// @throws InputError naming the element.
GltfGeometry geometry_of(const GltfContent& content);

}  // namespace seamflow
