#include "partition/formats/ply_plain.h"

#include <algorithm>
#include <bit>
#include <string>
#include <type_traits>

#include "partition/errors.h"
#include "partition/formats/ply_source.h"
#include "partition/io/byte_order.h"

namespace seamflow {

namespace {

/// One coordinate of each vertex.
/// @param first the bytes of the first vertex's coordinate. @param stride the number of bytes from one to the next.
void read_coordinates(PlyType type, const char* first, std::size_t stride, std::endian order, auto&& coordinates)
{
    with_type(type, [&](auto zero) {
        for (Index v = 0; v < coordinates.size(); ++v)
            coordinates[v] = static_cast<double>(from_bytes<decltype(zero)>(first + at(v) * stride, order));
    });
    if (!coordinates.allFinite())
        throw InputError("a coordinate is not a finite number");
}

void read_vertices(const PlyElement& element, const PlySlice& slice, std::endian order, const MeshSlice& place)
{
    const std::vector<PlyRole> roles = roles_of(element);
    const auto n = static_cast<Index>(slice.end - slice.begin);
    const std::size_t stride = slice.bytes.size() / at(n);
    const char* first = slice.bytes.data();
    for (std::size_t p = 0; p < roles.size(); ++p) {
        const PlyType type = element.properties[p].type;
        if (roles[p] != PlyRole::Other)
            read_coordinates(type, first, stride, order,
                             place.vertices.col(static_cast<Index>(roles[p])).segment(place.first_vertex, n));
        first += size_in_bytes(type);
    }
}

/// What precedes and follows the list of corners of a face, in bytes.
struct Surroundings {
    std::size_t before = 0;
    std::size_t behind = 0;
};

/// @tparam Length, Number the types in the list of corners.
template <class Length, class Number>
void read_faces(std::string_view bytes, const Surroundings& around, std::endian order, MeshBuilder& builder,
                Index n_vertices)
{
    std::vector<Index> corners;
    for (const char* next = bytes.data(); next < bytes.data() + bytes.size(); next += around.behind) {
        next += around.before;
        corners.resize(static_cast<std::size_t>(from_bytes<Length>(next, order)));
        next += sizeof(Length);
        for (Index& corner : corners) {
            corner = builder.vertex(from_bytes<Number>(next, order), n_vertices);
            next += sizeof(Number);
        }
        builder.add_face(corners);
    }
}

/// @param element has one list.
void read_faces(const PlyElement& element, const PlySlice& slice, std::endian order, const MeshSlice& place)
{
    const PlyProperty* list = nullptr;
    Surroundings around;
    for (const PlyProperty& property : element.properties) {
        if (property.length_type)
            list = &property;
        else
            (list == nullptr ? around.before : around.behind) += size_in_bytes(property.type);
    }
    const NoPosition position;
    MeshBuilder builder(position, 0, place);
    const auto n_vertices = static_cast<Index>(place.vertices.rows());
    with_type(*list->length_type, [&](auto length) {
        with_type(list->type, [&](auto number) {
            if constexpr (std::is_integral_v<decltype(length)> && std::is_integral_v<decltype(number)>)
                read_faces<decltype(length), decltype(number)>(slice.bytes, around, order, builder, n_vertices);
        });
    });
}

}  // namespace

std::vector<PlyRole> roles_of(const PlyElement& element)
{
    std::vector<PlyRole> roles;
    for (const PlyProperty& property : element.properties) {
        PlyRole role = PlyRole::Other;
        if (element.name == "vertex")
            role = property.name == "x"   ? PlyRole::X
                   : property.name == "y" ? PlyRole::Y
                   : property.name == "z" ? PlyRole::Z
                                          : PlyRole::Other;
        else if ((element.name == "face" || element.name == "tristrips") &&
                 (property.name == "vertex_indices" || property.name == "vertex_index"))
            role = PlyRole::Corners;
        roles.push_back(role);
    }
    return roles;
}

bool read_plain_slice(const PlyHeader& header, const PlySlice& slice, const MeshSlice& place)
{
    bool is_plain = false;
    for_each_kind(header.elements, slice, [&](const PlyElement& element, std::uint64_t, std::uint64_t) {
        const auto n_lists = std::ranges::count_if(
            element.properties, [](const PlyProperty& property) { return property.length_type.has_value(); });
        if (element.name == "vertex" && n_lists == 0)
            read_vertices(element, slice, order_of(header.encoding), place), is_plain = true;
        else if (element.name == "face" && n_lists == 1)
            read_faces(element, slice, order_of(header.encoding), place), is_plain = true;
    });
    return is_plain;
}

}  // namespace seamflow
