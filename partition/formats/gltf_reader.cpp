#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "partition/formats/gltf.h"
#include "partition/formats/gltf_geometry.h"
#include "partition/io/byte_order.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

namespace {

/// The position of an element in a list of a file, for messages.
class GltfPosition final : public InputPosition {
  public:
    GltfPosition(const std::filesystem::path& path, FaultLog* faults)
        : path_(path)
    {
        note_faults_in(faults);
    }

    /// Sets the position: element i of a list.
    /// @param list, element must live until the next call.
    void enter(const std::string& list, std::string_view element, std::int64_t i)
    {
        list_ = list;
        element_ = element;
        i_ = i;
    }

  private:
    [[nodiscard]] std::string position() const override
    {
        return fmt::format("{}: {}, {} {} (numbered from 0)", path_.string(), list_, element_, i_);
    }

    const std::filesystem::path& path_;
    std::string_view list_;
    std::string_view element_;
    std::int64_t i_ = 0;
};

/// The corners of the triangles of a primitive.
class GltfCorners {
  public:
    GltfCorners(const GltfContent& content, const GltfPrimitive& primitive)
        : primitive_(primitive)
        , bytes_(primitive.indices ? content.buffer(primitive.indices->buffer).data() + primitive.indices->offset
                                   : nullptr)
    {
    }

    /// The vertices of triangle t, numbered in the primitive.
    [[nodiscard]] std::array<std::int64_t, 3> operator()(std::int64_t t) const
    {
        switch (primitive_.mode) {
        case GltfPrimitive::Mode::Triangles:
            return {index(3 * t), index(3 * t + 1), index(3 * t + 2)};
        case GltfPrimitive::Mode::Strip:
            // Every other triangle of a strip has the opposite order of corners.
            return {index(t), index(t + 1 + t % 2), index(t + 2 - t % 2)};
        case GltfPrimitive::Mode::Fan:
            break;
        }
        return {index(t + 1), index(t + 2), index(0)};
    }

  private:
    [[nodiscard]] std::int64_t index(std::int64_t i) const
    {
        if (bytes_ == nullptr)
            return i;
        return gltf_index(bytes_ + static_cast<std::size_t>(i) * primitive_.indices->stride,
                          primitive_.indices->component);
    }

    const GltfPrimitive& primitive_;
    const char* bytes_;
};

/// Reads faces begin to end - 1. Triangles without area, which join strips and fans, are skipped.
void read_gltf_faces(const GltfContent& content, const GltfGeometry& geometry, std::int64_t begin, std::int64_t end,
                     GltfPosition& position, MeshBuilder& builder)
{
    auto primitive = std::ranges::upper_bound(geometry.primitives, begin, {}, &GltfPrimitive::first_face) - 1;
    for (; begin < end; ++primitive) {
        const GltfCorners corners(content, *primitive);
        const std::int64_t n = std::min(end, primitive->first_face + primitive->n_faces) - primitive->first_face;
        for (std::int64_t t = begin - primitive->first_face; t < n; ++t) {
            position.enter(primitive->name, "triangle", t);
            const std::array<std::int64_t, 3> given = corners(t);
            if (primitive->mode != GltfPrimitive::Mode::Triangles &&
                (given[0] == given[1] || given[1] == given[2] || given[2] == given[0]))
                continue;
            std::array<Index, 3> face;
            for (std::size_t k = 0; k < 3; ++k) {
                face[k] = builder.vertex(given[k], primitive->n_vertices);
                face[k] += face[k] >= 0 ? primitive->first_vertex : 0;
            }
            builder.add_face(face);
        }
        begin = primitive->first_face + n;
    }
}

/// Reads the vertices, and the faces slice by slice.
/// @param per_slice the number of faces of a slice. @param faults if not null, collects faults instead of throwing.
/// @throws InputError for a fault that `faults` does not collect; the message names the fault if all faces are in one
/// slice.
PolygonMesh read_gltf_slices(const GltfContent& content, const GltfGeometry& geometry, std::int64_t per_slice,
                             const Executor& exec, FaultLog* faults)
{
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(geometry.n_vertices);
    for_each_vector(
        geometry.positions, geometry.n_vertices, exec, [&](const GltfVectors& list, std::size_t i, Index v) {
            const Point point = float_vector(content.buffer(list.span.buffer), list.span, i);
            mesh.vertices.row(v) = point;
            GltfPosition position(content.path(), faults);
            position.enter(list.name, "vertex", static_cast<std::int64_t>(i));
            for (const double x : point)
                if (!std::isfinite(x))
                    position.fault("a coordinate is not a finite number; correct it or export the mesh again");
        });
    append_faces(mesh, static_cast<Index>((geometry.n_faces + per_slice - 1) / per_slice), exec,
                 [&](Index i, PolygonMesh& faces) {
                     const std::int64_t begin = i * per_slice;
                     GltfPosition position(content.path(), faults);
                     MeshBuilder builder(position, 0, {mesh.vertices, geometry.n_vertices, faces});
                     read_gltf_faces(content, geometry, begin, std::min(begin + per_slice, geometry.n_faces), position,
                                     builder);
                 });
    return mesh;
}

}  // namespace

PolygonMesh read_gltf(const std::filesystem::path& path, std::string_view file, const Slicing& slicing,
                      FaultLog* faults)
{
    GltfContent content(path, file);
    const GltfGeometry geometry = geometry_of(content);
    const auto in_one_go = [&] {
        return read_gltf_slices(content, geometry, geometry.n_faces + 1, run_serially, faults);
    };
    const auto in_slices = [&] {
        constexpr std::size_t bytes_per_face = 12;
        return read_gltf_slices(content, geometry, elements_per_slice(slicing, bytes_per_face), slicing.exec, nullptr);
    };
    return file.size() <= slicing.bytes ? in_one_go() : read_in_slices_if_faultless(in_slices, in_one_go);
}

}  // namespace seamflow
