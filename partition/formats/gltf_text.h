#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Pieces of the text of glTF files: URIs, and JSON as it is written.
namespace seamflow {

/// Whether a buffer is in the file itself, as text, rather than in another.
bool is_gltf_data(std::string_view uri);

/// `data:` URI of some bytes.
/// @param head what is before the comma.
std::string gltf_data(std::string_view head, std::string_view bytes);

/// The bytes that base64 stands for; nothing if a character is no digit of it.
std::optional<std::string> bytes_of_gltf_base64(std::string_view text);

/// A relative URI for the name of a file, and the name of such a URI.
std::string gltf_uri_of(std::string_view name);
std::string gltf_name_of(std::string_view uri);

/// The parts of a JSON text that is known to be correct, as they are written.
struct GltfMember {
    std::string key;
    std::string_view value;
    /// From the begin of the key to the end of the value.
    std::string_view whole;
};

/// The members of an object, or nothing for other values.
std::vector<GltfMember> gltf_members(std::string_view object);
/// The value of a member; empty if there is none.
std::string_view gltf_member(std::string_view object, std::string_view key);
/// The elements of an array, or nothing for other values.
std::vector<std::string_view> gltf_elements(std::string_view array);

/// Parts of a JSON text, which may be empty, and what replaces them. No two begin at the same place.
using JsonEdits = std::vector<std::pair<std::string_view, std::string>>;

/// The text with its parts replaced.
std::string edited_json(std::string_view text, JsonEdits edits);

}  // namespace seamflow
