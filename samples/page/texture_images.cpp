#include "samples/page/texture_images.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf_text.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

/// For all images of a page.
constexpr std::size_t most_image_bytes = 32'000'000;

/// The file that a name refers to; empty if there is none.
std::filesystem::path file_of(const std::filesystem::path& folder, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::filesystem::path path(name);
    std::error_code ignored;
    for (const std::filesystem::path& place : {folder / path, folder / path.filename()})
        if (std::filesystem::is_regular_file(place, ignored))
            return place;
    return {};
}

}  // namespace

std::string_view image_type(std::string_view bytes)
{
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"))
        return "image/png";
    if (bytes.starts_with("\xff\xd8\xff"))
        return "image/jpeg";
    if (bytes.starts_with("GIF8"))
        return "image/gif";
    if (bytes.starts_with("BM"))
        return "image/bmp";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP"))
        return "image/webp";
    return {};
}

std::string TextureImages::data_url(const std::string& name)
{
    const auto [entry, is_new] = known_.try_emplace(name);
    if (is_new)
        entry->second = read(name);
    return entry->second;
}

std::string TextureImages::read(const std::string& name)
{
    const std::filesystem::path path = file_of(folder_, name);
    if (path.empty()) {
        remarks_.push_back(fmt::format("The page lacks the texture {}, which is not beside the mesh.", name));
        return {};
    }
    try {
        const InputFile file{OpenFile(path)};
        const std::string_view bytes = file.content();
        const std::string_view type = image_type(bytes);
        if (type.empty()) {
            remarks_.push_back(
                fmt::format("The page lacks the texture {}, which is not a PNG, JPEG, WebP, GIF or BMP.", name));
            return {};
        }
        if (bytes.size() > most_image_bytes - bytes_) {
            remarks_.push_back(fmt::format("The page lacks the texture {}: a page holds at most {} MB of textures.",
                                           name, most_image_bytes / 1'000'000));
            return {};
        }
        bytes_ += bytes.size();
        return gltf_data(fmt::format("data:{};base64", type), bytes);
    } catch (const InputError& error) {
        remarks_.push_back(fmt::format("The page lacks a texture: {}.", error.what()));
        return {};
    }
}

}  // namespace seamflow
