#include "partition/formats/ply_plain.h"

#include <type_traits>

#include "partition/errors.h"
#include "partition/io/byte_order.h"

namespace seamflow {

namespace {

/// Reads the coordinates of vertices, which all have the same number of bytes.
/// @param slots without lists.
void read_plain_vertices(const std::vector<PlySlot>& slots, const PlySlice& slice, std::endian order,
                         const MeshSlice& mesh_slice)
{
    const auto n = static_cast<Index>(slice.end - slice.begin);
    const std::size_t stride = slice.bytes.size() / usize(n);
    const char* first = slice.bytes.data();
    for (const PlySlot& slot : slots) {
        if (slot.property == nullptr)
            break;
        first += slot.n_bytes;
        auto coordinates = mesh_slice.vertices.col(slot.column).segment(mesh_slice.first_vertex, n);
        with_type(slot.property->type, [&](auto zero) {
            for (Index v = 0; v < n; ++v)
                coordinates[v] = static_cast<double>(from_bytes<decltype(zero)>(first + usize(v) * stride, order));
        });
        if (!coordinates.allFinite())
            throw InputError("a coordinate is not a finite number");
        first += size_in_bytes(slot.property->type);
    }
}

/// Reads faces. Nothing is checked against the end of the slice, which is known to hold whole elements (see
/// PlyData::slices).
/// @tparam Length, Number the types in the list of corners. @param slots the list and the end.
template <class Length, class Number>
void read_plain_faces(const std::vector<PlySlot>& slots, std::string_view bytes, std::endian order,
                      const MeshSlice& mesh_slice)
{
    const NoPosition position;
    MeshBuilder builder(position, 0, mesh_slice);
    std::vector<Index> corners;
    for (const char* next = bytes.data(); next < bytes.data() + bytes.size(); next += slots.back().n_bytes) {
        next += slots.front().n_bytes;
        corners.resize(static_cast<std::size_t>(from_bytes<Length>(next, order)));
        next += sizeof(Length);
        for (Index& corner : corners) {
            corner = builder.vertex(from_bytes<Number>(next, order), mesh_slice.vertices.rows());
            next += sizeof(Number);
        }
        builder.add_face(corners);
    }
}

}  // namespace

bool read_plain_slice(const PlyHeader& header, const PlySlice& slice, const MeshSlice& mesh_slice)
{
    bool is_plain = false;
    const std::endian order = order_of(header.encoding);
    PlyData::for_each_kind(header.elements, slice, [&](const PlyElement& element, std::uint64_t, std::uint64_t) {
        const auto is_list = [](const PlyProperty& property) { return property.length_type.has_value(); };
        const auto n_lists = std::ranges::count_if(element.properties, is_list);
        is_plain = (element.name == "vertex" && n_lists == 0) || (element.name == "face" && n_lists == 1);
        if (!is_plain)
            return;
        if (n_lists == 0)
            return read_plain_vertices(slots_of(element, coordinates_in(element)), slice, order, mesh_slice);
        const std::vector<PlySlot> slots = slots_of(element, corners_in(element));
        with_type(*slots.front().property->length_type, [&](auto length) {
            with_type(slots.front().property->type, [&](auto number) {
                if constexpr (std::is_integral_v<decltype(length)> && std::is_integral_v<decltype(number)>)
                    read_plain_faces<decltype(length), decltype(number)>(slots, slice.bytes, order, mesh_slice);
            });
        });
    });
    return is_plain;
}

}  // namespace seamflow
