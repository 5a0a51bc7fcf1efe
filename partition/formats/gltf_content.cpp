#include "partition/formats/gltf_content.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/io/byte_order.h"

namespace seamflow {

namespace {

constexpr std::string_view signature = "glTF";
/// The beginning of a file in memory that has its buffers appended. No file can begin like this: it is no version of
/// the format.
constexpr std::string_view signature_with_buffers = "glTF\xff\xff\xff\xff";

[[noreturn]] void refuse_gltf(const std::filesystem::path& path, const std::string& complaint)
{
    throw InputError(path.string() + ": " + complaint);
}

/// The number at an offset; 0 where the bytes end first.
template <class Number>
Number number_at(std::string_view bytes, std::size_t offset)
{
    return offset <= bytes.size() && bytes.size() - offset >= sizeof(Number)
               ? from_bytes<Number>(bytes.data() + offset, std::endian::little)
               : 0;
}

/// The piece of `size` bytes that begins at an offset; shorter if the bytes end before.
std::string_view piece_at(std::string_view bytes, std::uint64_t offset, std::uint64_t size)
{
    return offset <= bytes.size() ? bytes.substr(offset, size) : std::string_view();
}

/// The bytes of a buffer that is in a `data:` URI, in base64.
std::string bytes_of_data(const GltfValue& uri)
{
    const std::string uri_text = uri.text();
    const std::string_view text = uri_text;
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || !text.substr(0, comma).ends_with(";base64"))
        uri.fail("the data are not in base64; export the mesh again");
    std::optional<std::string> bytes = bytes_of_gltf_base64(text.substr(comma + 1));
    if (!bytes)
        uri.fail("the data have characters that are not base64; export the mesh again");
    return std::move(*bytes);
}

/// The bytes of a buffer that is in another file.
InputFile bytes_of_file(const GltfContent& content, const GltfValue& uri)
{
    const std::filesystem::path name = gltf_name_of(uri.text());
    if (name.empty() || name.is_absolute() || uri.text().find("://") != std::string::npos)
        uri.fail(fmt::format("names {}, which is no file beside this one; put the buffer there and name it",
                             in_quotes(uri.text())));
    try {
        return InputFile(OpenFile(content.path().parent_path() / name, OpenFile::Packing::Keep));
    } catch (const InputError& error) {
        uri.fail(error.what());
    }
}

}  // namespace

GltfValue GltfValue::operator[](const std::string& key) const
{
    const std::string name = name_.empty() ? key : name_ + '.' + key;
    if (value_ == nullptr)
        return {path_, nullptr, name};
    if (!value_->is_object())
        fail("expected an object { … }; export the mesh again");
    // If several members have the same name, the last one counts.
    const auto found = std::find_if(value_->children.rbegin(), value_->children.rend(),
                                    [&](const JsonNode* member) { return text_of_json(member->key) == key; });
    return {path_, found != value_->children.rend() ? *found : nullptr, name};
}

std::size_t GltfValue::size() const
{
    if (value_ == nullptr)
        return 0;
    if (!value_->is_array())
        fail("expected a list [ … ]; export the mesh again");
    return value_->children.size();
}

GltfValue GltfValue::at(std::size_t i) const
{
    return {path_, value_->children[i], fmt::format("{}[{}]", name_, i)};
}

std::vector<std::string> GltfValue::keys() const
{
    std::vector<std::string> keys;
    if (value_ != nullptr && value_->is_object())
        for (const JsonNode* const member : value_->children)
            keys.push_back(text_of_json(member->key));
    return keys;
}

std::uint64_t GltfValue::number() const
{
    if (value_ == nullptr)
        fail("is missing; export the mesh again");
    // 2^53, up to which doubles hold all whole numbers.
    constexpr double most = 9007199254740992.0;
    double value = -1.0;
    std::from_chars(value_->source.data(), value_->source.data() + value_->source.size(), value);
    if (!(value >= 0.0 && value <= most) || value != std::floor(value))
        fail(fmt::format("expected a whole number of at least 0, but found {}; export the mesh again",
                         in_quotes(value_->source)));
    return static_cast<std::uint64_t>(value);
}

std::string GltfValue::text() const
{
    if (value_ == nullptr || !value_->is_text())
        fail("expected text; export the mesh again");
    return text_of_json(value_->source);
}

std::string GltfValue::position() const
{
    return name_.empty() ? path_.string() : path_.string() + ": " + name_;
}

GltfContent::GltfContent(const std::filesystem::path& path, std::string_view content)
    : path_(path)
{
    take_apart(content);
    try {
        json_ = JsonTree(text_);
    } catch (const nlohmann::json::parse_error& error) {
        refuse_gltf(path_, fmt::format("byte {} of the JSON text: this is not JSON; export the mesh again",
                                       std::max(error.byte, std::size_t{1}) - 1));
    } catch (const nlohmann::json::exception&) {
        refuse_gltf(path_, "the JSON text has a number that is too large; export the mesh again");
    }
    const GltfValue version = root()["asset"]["version"];
    if (version.is_there() && !version.text().starts_with("2."))
        version.fail(fmt::format("is {}, but only glTF 2.0 is read; convert the file", in_quotes(version.text())));
    const GltfValue list = root()["buffers"];
    buffers_.resize(list.size());
    if (!buffers_.empty() && !list.at(0)["uri"].is_there())
        buffers_[0] = chunk_;
    if (!content.starts_with(signature_with_buffers))
        return;
    // After the signature follow the size of the file, the file, and the same for each buffer.
    std::uint64_t next = signature_with_buffers.size() + sizeof(std::uint64_t) + file_.size();
    for (std::string_view& buffer : buffers_) {
        const auto size = number_at<std::uint64_t>(content, next);
        if (size > 0)
            buffer = piece_at(content, next + sizeof size, size);
        next += sizeof size + size;
    }
}

/// Finds the file, and within it the text and the binary chunk: sets file_, text_ and chunk_.
void GltfContent::take_apart(std::string_view content)
{
    file_ = content;
    if (content.starts_with(signature_with_buffers))
        file_ = piece_at(content, signature_with_buffers.size() + sizeof(std::uint64_t),
                         number_at<std::uint64_t>(content, signature_with_buffers.size()));
    text_ = file_;
    if (file_.starts_with(signature))
        find_chunks();
}

/// Finds the text and the binary chunk of a .glb file: sets text_ and chunk_.
void GltfContent::find_chunks()
{
    const auto version = number_at<std::uint32_t>(file_, signature.size());
    if (version != 2)
        refuse_gltf(
            path_,
            fmt::format("this is version {} of binary glTF, but only version 2 is read; convert the file", version));
    const std::uint64_t length = number_at<std::uint32_t>(file_, 2 * sizeof(std::uint32_t));
    if (length > file_.size())
        refuse_gltf(path_, fmt::format("the file announces {} bytes, but has only {}; it has been cut off: export or "
                                       "copy the mesh again",
                                       length, file_.size()));
    const std::string_view chunks = file_.substr(0, length);
    const auto chunk_at = [&](std::size_t offset, std::string_view kind, const char* name) -> std::string_view {
        const std::uint64_t size = number_at<std::uint32_t>(chunks, offset);
        if (piece_at(chunks, offset + sizeof(std::uint32_t), kind.size()) != kind)
            return {};
        if (size > chunks.size() - offset - glb_chunk_header_bytes)
            refuse_gltf(path_, fmt::format("the {} chunk announces {} bytes, but the file ends first; export or copy "
                                           "the mesh again",
                                           name, size));
        return chunks.substr(offset + glb_chunk_header_bytes, size);
    };
    text_ = chunk_at(glb_header_bytes, "JSON", "JSON");
    if (text_.data() == nullptr)
        refuse_gltf(path_, "the file does not begin with a JSON chunk; export the mesh again");
    chunk_ = chunk_at(glb_header_bytes + glb_chunk_header_bytes + text_.size(), std::string_view("BIN\0", 4), "binary");
}

GltfValue GltfContent::named_by(const GltfValue& number, const std::string& list) const
{
    const std::uint64_t i = number.number();
    const GltfValue elements = root()[list];
    if (i >= elements.size())
        number.fail(
            fmt::format("names {}[{}], but the file has {} of them; export the mesh again", list, i, elements.size()));
    return elements.at(i);
}

std::optional<OpenFile> with_gltf_buffers(const OpenFile& file, std::string_view content)
{
    if (content.starts_with(signature_with_buffers))
        refuse_gltf(file.path(), "this is no version of binary glTF; export the mesh again");
    const GltfContent gltf(file.path(), content);
    std::vector<std::string> decoded;
    std::vector<InputFile> files;
    std::vector<std::string_view> bytes;
    decoded.reserve(gltf.n_buffers());
    files.reserve(gltf.n_buffers());
    bool are_within = true;
    for (std::size_t i = 0; i < gltf.n_buffers(); ++i) {
        const GltfValue uri = gltf.root()["buffers"].at(i)["uri"];
        are_within &= !uri.is_there();
        if (!uri.is_there())
            bytes.emplace_back();
        else if (is_gltf_data(uri.text()))
            bytes.emplace_back(decoded.emplace_back(bytes_of_data(uri)));
        else
            bytes.emplace_back(files.emplace_back(bytes_of_file(gltf, uri)).content());
    }
    if (are_within)
        return std::nullopt;
    bytes.insert(bytes.begin(), content);
    std::vector<std::array<char, sizeof(std::uint64_t)>> sizes;
    sizes.reserve(bytes.size());
    std::vector<std::string_view> pieces{signature_with_buffers};
    for (const std::string_view part : bytes) {
        const auto& size = sizes.emplace_back(to_bytes(std::uint64_t{part.size()}, std::endian::little));
        pieces.emplace_back(size.data(), size.size());
        pieces.push_back(part);
    }
    return OpenFile::in_memory(file.path(), pieces);
}

void write_glb_head(ByteWriter& file, std::string_view text, std::size_t n_behind)
{
    file.text(signature);
    file.binary(std::uint32_t{2}, std::endian::little);
    file.binary(static_cast<std::uint32_t>(glb_header_bytes + glb_chunk_header_bytes + text.size() + n_behind),
                std::endian::little);
    file.binary(static_cast<std::uint32_t>(text.size()), std::endian::little);
    file.text("JSON");
    file.text(text);
}

}  // namespace seamflow
