#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// JSON texts of glTF files, in which each value keeps its source text.
namespace seamflow {

/// A value in a JSON text.
struct JsonNode {
    std::string_view source;
    /// The key with its quotation marks; empty if the value is no member of an object.
    std::string_view key = {};
    /// The elements of an array, the values of an object.
    std::vector<const JsonNode*> children = {};

    [[nodiscard]] bool is_object() const { return source.front() == '{'; }
    [[nodiscard]] bool is_array() const { return source.front() == '['; }
    [[nodiscard]] bool is_text() const { return source.front() == '"'; }

    /// The text of the value, with its key if it has one.
    [[nodiscard]] std::string_view member() const
    {
        const char* const begin = key.empty() ? source.data() : key.data();
        return {begin, static_cast<std::size_t>(source.data() + source.size() - begin)};
    }
};

/// The values of a JSON text. Its destruction needs neither memory nor recursion, unlike that of nlohmann's values.
class JsonTree {
  public:
    /// A tree without values.
    JsonTree() = default;
    /// @param text must outlive this object; it ends at a zero byte. @throws nlohmann::json::exception if it is not
    /// JSON.
    explicit JsonTree(std::string_view text);

    /// @pre there is a value.
    [[nodiscard]] const JsonNode& root() const { return nodes_.front(); }

  private:
    std::deque<JsonNode> nodes_;
};

/// The text that a JSON string, in quotation marks, stands for.
std::string text_of_json(std::string_view source);

/// The JSON string for a text.
std::string json_of_text(std::string_view text);

/// Ranges of a JSON text, which may be empty, with their replacements. No two begin at the same character.
using JsonEdits = std::vector<std::pair<std::string_view, std::string>>;

/// The text with these ranges replaced.
std::string edited_json(std::string_view text, JsonEdits edits);

}  // namespace seamflow
