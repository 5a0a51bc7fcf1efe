#include "solvers/denoising/mixing_weights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace seamflow {

namespace {

/// The paragraphs of mixing_weights.txt, which the build embeds.
constexpr auto paragraphs = std::to_array<std::string_view>({
#include "solvers/denoising/mixing_weights_text.inc"
});
// One at least for the cascade, and the last for the noise.
static_assert(paragraphs.size() > 1, "mixing_weights.txt has no blank lines between its paragraphs");

/// The bytes that a text in base 64 encodes (RFC 4648). Line ends are passed over.
std::string decode(std::string_view text)
{
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr int bits_of_digit = 6;
    constexpr int bits_of_byte = 8;
    std::string bytes;
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char c : text) {
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos)
            continue;
        bits = bits << bits_of_digit | static_cast<std::uint32_t>(digit);
        n_bits += bits_of_digit;
        if (n_bits < bits_of_byte)
            continue;
        n_bits -= bits_of_byte;
        bytes.push_back(static_cast<char>(bits >> n_bits & 0xffU));
    }
    return bytes;
}

/// The weights of all networks, in the order of the file.
const std::vector<std::string>& all_weights()
{
    static const std::vector<std::string> all = [] {
        std::vector<std::string> weights;
        for (const std::string_view paragraph : paragraphs)
            weights.push_back(decode(paragraph));
        return weights;
    }();
    return all;
}

}  // namespace

std::span<const std::string> mixing_weights()
{
    return std::span(all_weights()).first(all_weights().size() - 1);
}

const std::string& noise_weights()
{
    return all_weights().back();
}

}  // namespace seamflow
