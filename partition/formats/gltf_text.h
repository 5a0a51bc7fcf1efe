#pragma once

#include <optional>
#include <string>
#include <string_view>

/// URIs in glTF files.
namespace seamflow {

/// Whether a buffer is in the file itself, as text, rather than in another.
bool is_gltf_data(std::string_view uri);

/// `data:` URI of some bytes.
/// @param head the text before the comma.
std::string gltf_data(std::string_view head, std::string_view bytes);

/// Appends bytes in base64 (RFC 4648).
void append_base64(std::string_view bytes, std::string& text);

/// The bytes that a base64 text encodes; nothing if a character is no base64 digit.
std::optional<std::string> bytes_of_gltf_base64(std::string_view text);

/// A relative URI for the name of a file, and the name of such a URI.
std::string gltf_uri_of(std::string_view name);
std::string gltf_name_of(std::string_view uri);

}  // namespace seamflow
