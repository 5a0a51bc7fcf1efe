#include "partition/formats/gltf_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "partition/formats/splicing.h"
#include "partition/io/byte_writer.h"

namespace seamflow {

namespace {

using Json = nlohmann::json;

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr auto base64_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(64);
    for (std::size_t i = 0; i < base64_digits.size(); ++i)
        values[static_cast<unsigned char>(base64_digits[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

constexpr std::string_view json_blanks = " \t\r\n";

/// Walks through the parts of a JSON text.
class JsonWalk {
  public:
    explicit JsonWalk(std::string_view text)
        : text_(text)
    {
        skip_blanks();
    }

    [[nodiscard]] bool is_at(char c) const { return next_ < text_.size() && text_[next_] == c; }

    /// Skips one character and blanks behind it.
    void skip()
    {
        ++next_;
        skip_blanks();
    }

    /// The value that begins here, with the blanks behind it skipped.
    std::string_view value()
    {
        const std::size_t begin = next_;
        int depth = 0;
        do {
            const bool opens = is_at('{') || is_at('[');
            const bool closes = is_at('}') || is_at(']');
            depth += opens ? 1 : closes ? -1 : 0;
            if (is_at('"'))
                skip_string();
            else if (opens || closes)
                ++next_;
            else
                skip_to(depth > 0 ? "\"{}[]" : ",}] \t\r\n");
        } while (depth > 0 && next_ < text_.size());
        const std::string_view value = text_.substr(begin, next_ - begin);
        skip_blanks();
        return value;
    }

  private:
    void skip_blanks() { next_ = std::min(text_.find_first_not_of(json_blanks, next_), text_.size()); }

    void skip_to(const char* characters) { next_ = std::min(text_.find_first_of(characters, next_), text_.size()); }

    void skip_string()
    {
        ++next_;
        for (skip_to("\"\\"); is_at('\\'); skip_to("\"\\"))
            next_ += 2;
        next_ = std::min(next_ + 1, text_.size());
    }

    std::string_view text_;
    std::size_t next_ = 0;
};

}  // namespace

std::optional<std::string> bytes_of_gltf_base64(std::string_view text)
{
    while (text.ends_with('='))
        text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char c : text) {
        const std::uint8_t value = base64_values[static_cast<unsigned char>(c)];
        if (value >= base64_digits.size())
            return std::nullopt;
        bits = bits << 6 | value;
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            bytes += static_cast<char>(bits >> n_bits & 0xff);
        }
    }
    return bytes;
}

bool is_gltf_data(std::string_view uri)
{
    return uri.starts_with("data:");
}

std::string gltf_data(std::string_view head, std::string_view bytes)
{
    std::string text(head);
    text.reserve(head.size() + 1 + (bytes.size() + 2) / 3 * 4);
    text += ',';
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? base64_digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string gltf_uri_of(std::string_view name)
{
    std::string uri;
    for (const char c : name)
        if (static_cast<unsigned char>(c) <= ' ' ||
            std::string_view("%\"\\#?<>^`{|}:\x7f").find(c) != std::string_view::npos)
            uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        else
            uri += c;
    return uri;
}

std::string gltf_name_of(std::string_view uri)
{
    const auto digit = [&](std::size_t i) {
        return i < uri.size() ? std::string_view("0123456789abcdef").find(static_cast<char>(uri[i] | 0x20))
                              : std::string_view::npos;
    };
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_escape = uri[i] == '%' && digit(i + 1) < 16 && digit(i + 2) < 16;
        name += is_escape ? static_cast<char>(digit(i + 1) << 4 | digit(i + 2)) : uri[i];
        i += is_escape ? 2 : 0;
    }
    return name;
}

std::vector<GltfMember> gltf_members(std::string_view object)
{
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (object.starts_with(byte_order_mark))
        object.remove_prefix(byte_order_mark.size());
    std::vector<GltfMember> members;
    JsonWalk walk(object);
    if (!walk.is_at('{'))
        return members;
    for (walk.skip(); walk.is_at('"');) {
        const std::string_view key = walk.value();
        walk.skip();
        const std::string_view value = walk.value();
        const auto size = static_cast<std::size_t>(value.data() + value.size() - key.data());
        members.push_back({Json::parse(key.begin(), key.end()).get<std::string>(), value, {key.data(), size}});
        if (walk.is_at(','))
            walk.skip();
    }
    return members;
}

std::string_view gltf_member(std::string_view object, std::string_view key)
{
    std::string_view found;
    // Of members with the same name the last one counts, as for the parser.
    for (const GltfMember& member : gltf_members(object))
        if (member.key == key)
            found = member.value;
    return found;
}

std::vector<std::string_view> gltf_elements(std::string_view array)
{
    std::vector<std::string_view> elements;
    JsonWalk walk(array);
    if (!walk.is_at('['))
        return elements;
    for (walk.skip(); !walk.is_at(']');) {
        elements.push_back(walk.value());
        if (elements.back().empty())
            break;
        if (walk.is_at(','))
            walk.skip();
    }
    return elements;
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
