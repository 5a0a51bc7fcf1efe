#include "partition/formats/gltf_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "partition/formats/splicing.h"
#include "partition/io/byte_writer.h"

namespace seamflow {

namespace {

using Json = nlohmann::json;

/// The end of the string, number or word that begins at `begin`.
std::size_t end_of_scalar(std::string_view text, std::size_t begin)
{
    if (text[begin] != '"')
        return std::min(text.find_first_of(",]} \t\r\n", begin), text.size());
    std::size_t next = begin + 1;
    while (text[next] != '"')
        next += text[next] == '\\' ? 2 : 1;
    return next + 1;
}

}  // namespace

JsonTree::JsonTree(std::string_view text)
{
    // Checks the text; the callback discards all values.
    [[maybe_unused]] const Json nothing =
        Json::parse(text.begin(), text.end(), [](int, Json::parse_event_t, Json&) { return false; });
    // The text ends at a zero byte: some programs fill chunks up with zeros.
    text = text.substr(0, text.find('\0'));
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    std::size_t next = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    // The arrays and objects that have not ended yet. As the text is valid, commas and colons tell nothing new.
    std::vector<JsonNode*> open;
    std::string_view key;
    while ((next = text.find_first_not_of(" \t\r\n,:", next)) != std::string_view::npos) {
        if (text[next] == ']' || text[next] == '}') {
            ++next;
            std::string_view& source = open.back()->source;
            source = {source.data(), static_cast<std::size_t>(text.data() + next - source.data())};
            open.pop_back();
            continue;
        }
        const bool opens = text[next] == '[' || text[next] == '{';
        const std::size_t end = opens ? next + 1 : end_of_scalar(text, next);
        const std::string_view source = text.substr(next, end - next);
        next = end;
        if (!open.empty() && open.back()->is_object() && key.empty()) {
            key = source;
            continue;
        }
        JsonNode& node = nodes_.emplace_back(JsonNode{.source = source, .key = key});
        key = {};
        if (!open.empty())
            open.back()->children.push_back(&node);
        if (opens)
            open.push_back(&node);
    }
}

std::string text_of_json(std::string_view source)
{
    if (source.find('\\') == std::string_view::npos)
        return std::string(source.substr(1, source.size() - 2));
    return Json::parse(source.begin(), source.end()).get<std::string>();
}

std::string json_of_text(std::string_view text)
{
    return Json(text).dump();
}

std::string edited_json(std::string_view text, JsonEdits edits)
{
    std::ranges::sort(edits, {}, [](const auto& edit) { return edit.first.data(); });
    OutputBuffer now;
    Splicer splicer(now, text);
    for (const auto& [part, replacement] : edits)
        splicer.exchange(part).text(replacement);
    splicer.finish();
    return std::string(now.content());
}

}  // namespace seamflow
