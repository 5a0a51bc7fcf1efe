#include "tests/support/gltf_files.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "partition/io/byte_order.h"

namespace seamflow::test {

namespace {

std::string in_four_bytes(std::size_t number)
{
    const auto bytes = to_bytes(static_cast<std::uint32_t>(number), std::endian::little);
    return {bytes.data(), bytes.size()};
}

void add_to_list(std::string& list, const std::string& element)
{
    list += (list.empty() ? "" : ",") + element;
}

}  // namespace

int GltfMaker::view(std::string_view bytes, const std::string& others)
{
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    add_to_list(views_, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}{}}})", bytes_.size(),
                                    bytes.size(), others.empty() ? "" : ",", others));
    bytes_ += bytes;
    return n_views_++;
}

int GltfMaker::accessor(int view, int component, int count, const std::string& type, const std::string& others)
{
    add_to_list(accessors_, fmt::format(R"({{{}"componentType":{},"count":{},"type":"{}"{}{}}})",
                                        view < 0 ? "" : fmt::format(R"("bufferView":{},)", view), component, count,
                                        type, others.empty() ? "" : ",", others));
    return n_accessors_++;
}

std::string GltfMaker::sparse(int indices, std::size_t width, std::size_t count, int values)
{
    return fmt::format(R"("sparse":{{"count":{},"indices":{{"bufferView":{},"componentType":{}}},)"
                       R"("values":{{"bufferView":{}}}}})",
                       count, indices,
                       width == 1   ? 5121
                       : width == 2 ? 5123
                                    : 5125,
                       values);
}

int GltfMaker::vectors(const std::vector<float>& numbers)
{
    std::string bounds[2];
    for (std::size_t k = 0; k < 3; ++k) {
        float least = std::numeric_limits<float>::infinity();
        float largest = -least;
        for (std::size_t i = k; i < numbers.size(); i += 3) {
            least = std::min(least, numbers[i]);
            largest = std::max(largest, numbers[i]);
        }
        add_to_list(bounds[0], fmt::format("{}", double{least}));
        add_to_list(bounds[1], fmt::format("{}", double{largest}));
    }
    return accessor(view(bytes_of(numbers)), 5126, static_cast<int>(numbers.size() / 3), "VEC3",
                    fmt::format(R"("min":[{}],"max":[{}])", bounds[0], bounds[1]));
}

void GltfMaker::mesh(std::initializer_list<std::string> primitives)
{
    std::string list;
    for (const std::string& primitive : primitives)
        add_to_list(list, primitive);
    add_to_list(meshes_, R"({"primitives":[)" + list + "]}");
}

std::string GltfMaker::text(const std::string& uri) const
{
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"meshes":[{}],"accessors":[{}],"bufferViews":[{}],)"
                       R"("buffers":[{{"byteLength":{}{}}}]{}{}}})",
                       meshes_, accessors_, views_, bytes_.size(),
                       uri.empty() ? "" : fmt::format(R"(,"uri":"{}")", uri), more.empty() ? "" : ",", more);
}

std::string GltfMaker::glb(std::string text, std::string bytes)
{
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    return "glTF" + in_four_bytes(2) + in_four_bytes(28 + text.size() + bytes.size()) + in_four_bytes(text.size()) +
           "JSON" + text + in_four_bytes(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

}  // namespace seamflow::test
