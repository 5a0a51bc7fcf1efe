#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "partition/formats/gltf_json.h"
#include "partition/formats/gltf_text.h"
#include "partition/io/byte_writer.h"
#include "partition/io/input_position.h"

namespace seamflow {

/// A value in the JSON text of a glTF file, or a missing value. Messages name it as in `meshes[0].primitives[1]`.
class GltfValue final : public InputPosition {
  public:
    /// @param path, value must outlive this object. @param name empty: the whole text.
    GltfValue(const std::filesystem::path& path, const JsonNode* value, std::string name)
        : path_(path)
        , value_(value)
        , name_(std::move(name))
    {
    }

    [[nodiscard]] bool is_there() const { return value_ != nullptr; }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// A member of an object.
    /// @throws InputError if this value exists and is no object.
    [[nodiscard]] GltfValue operator[](const std::string& key) const;

    /// The number of elements of an array; 0 for a missing value.
    /// @throws InputError if this value exists and is no array.
    [[nodiscard]] std::size_t size() const;
    /// @pre i < size().
    [[nodiscard]] GltfValue at(std::size_t i) const;

    /// The names of the members; none for a missing value.
    [[nodiscard]] std::vector<std::string> keys() const;

    /// A whole number from 0 to 2^53.
    /// @throws InputError for any other value, and for a missing one.
    [[nodiscard]] std::uint64_t number() const;
    [[nodiscard]] std::uint64_t number_or(std::uint64_t otherwise) const { return is_there() ? number() : otherwise; }

    /// The text of a string.
    /// @throws InputError if this is no string.
    [[nodiscard]] std::string text() const;

    /// The JSON text of the value; empty for a missing value.
    [[nodiscard]] std::string_view source() const { return value_ != nullptr ? value_->source : std::string_view(); }
    /// The elements or members; none for a missing value or one of another type.
    [[nodiscard]] std::vector<const JsonNode*> nodes() const
    {
        return value_ != nullptr ? value_->children : std::vector<const JsonNode*>();
    }

  private:
    [[nodiscard]] std::string position() const override;

    const std::filesystem::path& path_;
    const JsonNode* value_;
    std::string name_;
};

/// The pieces of a glTF file.
class GltfContent {
  public:
    /// @param path for messages; must outlive this object, as must `content`.
    /// @param content of the file, or of the result of with_gltf_buffers if there is one.
    /// @throws InputError if it is not glTF 2.0.
    GltfContent(const std::filesystem::path& path, std::string_view content);

    /// The path of the file, for messages.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// A .glb file, or the text of a .gltf file.
    [[nodiscard]] std::string_view file() const { return file_; }
    [[nodiscard]] bool is_binary() const { return file_.data() != text_.data(); }
    /// The JSON text within the file.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// The binary chunk within the file; empty if there is none.
    [[nodiscard]] std::string_view chunk() const { return chunk_; }

    /// The value of the whole text.
    [[nodiscard]] GltfValue root() const { return {path_, &json_.root(), ""}; }

    /// The element of a list that a number names.
    /// @param list such as "accessors".
    /// @throws InputError if there is no such element.
    [[nodiscard]] GltfValue named_by(const GltfValue& number, const std::string& list) const;

    /// All bytes of a buffer, perhaps more than its length.
    /// @pre the buffer is in the file's list, or was added.
    [[nodiscard]] std::string_view buffer(std::size_t i) const { return buffers_[i]; }
    [[nodiscard]] std::size_t n_buffers() const { return buffers_.size(); }

    /// Adds a buffer after those of the file.
    /// @returns its number.
    std::size_t add_buffer(std::string bytes)
    {
        buffers_.emplace_back(added_.emplace_back(std::move(bytes)));
        return buffers_.size() - 1;
    }

  private:
    void take_apart(std::string_view content);
    void find_chunks();

    const std::filesystem::path& path_;
    std::string_view file_;
    std::string_view text_;
    std::string_view chunk_;
    std::vector<std::string_view> buffers_;
    std::deque<std::string> added_;
    JsonTree json_;
};

constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t glb_chunk_header_bytes = 8;

/// Writes the header and the first chunk of a .glb file.
/// @param text of a multiple of four bytes. @param n_behind the number of bytes that follow it.
void write_glb_head(ByteWriter& file, std::string_view text, std::size_t n_behind);

}  // namespace seamflow
