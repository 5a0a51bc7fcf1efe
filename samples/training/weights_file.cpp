#include "samples/training/weights_file.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr std::string_view begin_of_weights = "// clang-format off\n";
constexpr std::string_view end_of_weights = "// clang-format on\n";
constexpr std::size_t line_width = 112;

/// Base 64 (RFC 4648).
std::string encode(std::string_view bytes)
{
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr std::size_t group = 3;
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += group) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + group; ++k)
            bits = bits << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
        for (std::size_t k = 0; k <= group; ++k)
            text += k <= bytes.size() - i ? digits[bits >> (18U - 6U * k) & 63U] : '=';
    }
    return text;
}

std::string definition(std::string_view name, std::string_view bytes)
{
    const std::string text = encode(bytes);
    std::string lines = fmt::format("constexpr std::string_view weights_of_{} =", name);
    for (std::size_t i = 0; i < text.size(); i += line_width)
        lines += fmt::format("\n    \"{}\"", text.substr(i, line_width));
    return lines + ";\n";
}

}  // namespace

std::string replace_weights(std::string_view source, const TrainedDenoiser& trained)
{
    const std::size_t begin = source.find(begin_of_weights);
    const std::size_t end = source.find(end_of_weights);
    if (begin == std::string_view::npos || end == std::string_view::npos || end < begin)
        throw InputError("the file is not mixing_weights.cpp: no lines say where the weights begin and end");
    std::string text(source.substr(0, begin + begin_of_weights.size()));
    for (std::size_t stage = 0; stage < trained.stages.size(); ++stage)
        text += definition(fmt::format("stage_{}", stage + 1), trained.stages[stage]) + "\n";
    return text + definition("noise", trained.noise) + std::string(source.substr(end));
}

}  // namespace seamflow
