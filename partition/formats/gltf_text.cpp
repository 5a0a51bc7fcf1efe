#include "partition/formats/gltf_text.h"

#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace seamflow {

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The value of each character as a base64 digit; 64 for all others.
constexpr auto base64_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(64);
    for (std::size_t i = 0; i < base64_digits.size(); ++i)
        values[static_cast<unsigned char>(base64_digits[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

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
    append_base64(bytes, text);
    return text;
}

void append_base64(std::string_view bytes, std::string& text)
{
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? base64_digits[bits >> (18 - 6 * k) & 63] : '=';
    }
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
    // The value of the hexadecimal digit at i. The bit 0x20 makes letters lower case; the digits have it.
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

}  // namespace seamflow
