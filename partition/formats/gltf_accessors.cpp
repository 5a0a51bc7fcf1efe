#include "partition/formats/gltf_accessors.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "partition/text.h"

namespace seamflow {

namespace {

/// The sizes of the types of numbers, in bytes; 5120 and 5122 are signed.
constexpr std::array<std::pair<std::uint64_t, std::size_t>, 6> bytes_of_components = {
    {{5120, 1}, {gltf_byte, 1}, {5122, 2}, {gltf_short, 2}, {gltf_int, 4}, {gltf_float, 4}}};

/// The number of numbers in an element of each type.
constexpr std::array<std::pair<std::string_view, std::size_t>, 7> components_of_types = {
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

/// The second member of the row of a table that has the key.
/// @throws InputError naming `value`, the place of the key in the file, if there is none.
template <class Table, class Key>
std::size_t found_in(const Table& table, const Key& key, const GltfValue& value)
{
    const auto found = std::ranges::find(table, key, [](const auto& row) { return row.first; });
    if (found == table.end())
        value.fail("is not known to glTF 2.0; export the mesh again");
    return found->second;
}

/// The bytes of a buffer view, as the span of one element.
GltfSpan view_of(const GltfContent& content, const GltfValue& view)
{
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (view["extensions"][extension].is_there())
            view.fail(fmt::format("is compressed by meshopt ({}); export the mesh without compression", extension));
    static_cast<void>(content.named_by(view["buffer"], "buffers"));
    const std::uint64_t buffer = view["buffer"].number();
    const GltfValue length = content.root()["buffers"].at(buffer)["byteLength"];
    const std::size_t there = content.buffer(buffer).size();
    if (length.number() > there)
        length.fail(fmt::format("is {}, but the buffer has only {}; it has been cut off: export or copy it again",
                                length.number(), counted(there, "byte", "bytes")));
    const std::uint64_t offset = view["byteOffset"].number_or(0);
    const std::uint64_t size = view["byteLength"].number();
    if (offset > length.number() || size > length.number() - offset)
        view.fail(fmt::format("ends at byte {} of a buffer of {}; export the mesh again", offset + size,
                              counted(length.number(), "byte", "bytes")));
    return {.buffer = buffer, .offset = offset, .stride = view["byteStride"].number_or(0), .size = size, .count = 1};
}

/// The type of the elements of an accessor, and their number.
GltfSpan elements_of(const GltfValue& accessor)
{
    const GltfValue type = accessor["type"];
    GltfSpan span;
    span.component = accessor["componentType"].number();
    span.n_components = found_in(components_of_types, type.text(), type);
    span.size = span.n_components * found_in(bytes_of_components, span.component, accessor["componentType"]);
    span.stride = span.size;
    return span;
}

/// The number of elements that an accessor or a list of replacements has, at least 1.
std::size_t count_of(const GltfValue& list)
{
    const std::uint64_t count = list["count"].number();
    if (count == 0)
        list["count"].fail("there is no element; export the mesh again");
    return count;
}

/// Finds elements in a view.
/// @param source names the view, and perhaps an offset in it. @param span their type and number.
GltfSpan span_in_view(const GltfContent& content, const GltfValue& source, GltfSpan span)
{
    const GltfValue view = content.named_by(source["bufferView"], "bufferViews");
    const GltfSpan bytes = view_of(content, view);
    const std::uint64_t offset = source["byteOffset"].number_or(0);
    span.buffer = bytes.buffer;
    span.offset = bytes.offset + offset;
    span.stride = bytes.stride > 0 ? bytes.stride : span.size;
    if (span.stride < span.size)
        view["byteStride"].fail(fmt::format("is {}, but the elements of {} have {} bytes; export the mesh again",
                                            span.stride, source.name(), span.size));
    if (offset > bytes.size || bytes.size - offset < span.size ||
        span.count - 1 > (bytes.size - offset - span.size) / span.stride)
        source.fail(fmt::format("its {} do not fit into {}, which has {}; export the mesh again",
                                counted(span.count, "element", "elements"), view.name(),
                                counted(bytes.size, "byte", "bytes")));
    return span;
}

/// The index of the i-th replaced element.
/// @param buffer the bytes of the buffer with the indices.
std::uint32_t index_of(const GltfSparse& sparse, std::string_view buffer, std::size_t i)
{
    return gltf_index(buffer.data() + sparse.indices.offset + i * sparse.indices.stride, sparse.indices.component);
}

/// Checks that the indices of replaced elements ascend, and are less than the number of elements.
void require_ascending(const GltfContent& content, const GltfValue& list, const GltfSparse& sparse)
{
    std::int64_t last = -1;
    for (std::size_t i = 0; i < sparse.indices.count; ++i) {
        const std::uint32_t index = index_of(sparse, content.buffer(sparse.indices.buffer), i);
        if (index >= sparse.dense.count)
            list.fail(fmt::format("number {} of them is {}, but the accessor has {} (all numbered from 0); export the "
                                  "mesh again",
                                  i, index, counted(sparse.dense.count, "element", "elements")));
        if (index <= last)
            list.fail(fmt::format("number {} of them (numbered from 0) is {} and follows {}, but they must ascend; "
                                  "export the mesh again",
                                  i, index, last));
        last = index;
    }
}

/// Refuses a sparse accessor of more elements than the file has bytes to name them by: a few bytes could announce any
/// number of zeros.
void require_few(const GltfContent& content, const GltfValue& accessor, std::size_t count)
{
    std::size_t n_bytes = 0;
    for (std::size_t i = 0; i < content.n_buffers(); ++i)
        n_bytes += content.buffer(i).size();
    if (count > n_bytes)
        accessor["count"].fail(
            fmt::format("is {}, but there is no bufferView, and all buffers have only {}; export the "
                        "mesh again",
                        count, counted(n_bytes, "byte", "bytes")));
}

}  // namespace

void require_gltf_indices(const GltfSpan& span, const GltfValue& name)
{
    const std::uint64_t type = span.component;
    if (span.n_components != 1 || (type != gltf_byte && type != gltf_short && type != gltf_int))
        name.fail("the indices are not whole numbers of 1, 2 or 4 bytes without sign; export the mesh again");
}

GltfSpan span_of_gltf(const GltfContent& content, const GltfValue& accessor)
{
    if (accessor["sparse"].is_there())
        accessor.fail("is sparse, and so is not one list of data");
    if (!accessor["bufferView"].is_there())
        accessor.fail("has no bufferView and so no data; export the mesh again");
    GltfSpan span = elements_of(accessor);
    span.count = count_of(accessor);
    return span_in_view(content, accessor, span);
}

GltfSparse sparse_of_gltf(GltfContent& content, const GltfValue& number)
{
    const GltfValue accessor = content.named_by(number, "accessors");
    const GltfValue replaced = accessor["sparse"];
    GltfSparse sparse{.accessor = number.number(), .base = {}, .indices = {}, .values = {}, .dense = {}};
    sparse.dense = elements_of(accessor);
    sparse.dense.count = count_of(accessor);
    if (accessor["bufferView"].is_there())
        sparse.base = span_in_view(content, accessor, sparse.dense);
    else
        require_few(content, accessor, sparse.dense.count);
    sparse.values = sparse.dense;
    sparse.values.count = count_of(replaced);
    sparse.values = span_in_view(content, replaced["values"], sparse.values);
    const GltfValue indices = replaced["indices"];
    sparse.indices.component = indices["componentType"].number();
    sparse.indices.size = found_in(bytes_of_components, sparse.indices.component, indices["componentType"]);
    sparse.indices.n_components = 1;
    sparse.indices.count = sparse.values.count;
    require_gltf_indices(sparse.indices, indices);
    sparse.indices = span_in_view(content, indices, sparse.indices);
    require_ascending(content, indices, sparse);
    sparse.dense.buffer = content.add_buffer(dense_bytes(sparse, [&](std::size_t i) { return content.buffer(i); }));
    return sparse;
}

std::string dense_bytes(const GltfSparse& sparse, const std::function<std::string_view(std::size_t)>& buffer)
{
    const std::size_t size = sparse.dense.size;
    std::string bytes(size * sparse.dense.count, '\0');
    const auto copy = [&](const GltfSpan& from, std::size_t i, std::size_t to) {
        std::copy_n(buffer(from.buffer).begin() + static_cast<std::ptrdiff_t>(from.offset + i * from.stride), size,
                    bytes.begin() + static_cast<std::ptrdiff_t>(to * size));
    };
    for (std::size_t i = 0; sparse.base && i < sparse.dense.count; ++i)
        copy(*sparse.base, i, i);
    for (std::size_t i = 0; i < sparse.indices.count; ++i)
        copy(sparse.values, i, index_of(sparse, buffer(sparse.indices.buffer), i));
    return bytes;
}

}  // namespace seamflow
