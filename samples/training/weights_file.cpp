#include "samples/training/weights_file.h"

#include <cstddef>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf_text.h"

namespace seamflow {

namespace {

constexpr std::string_view begin_of_weights = "// clang-format off\n";
constexpr std::string_view end_of_weights = "// clang-format on\n";
constexpr std::size_t line_width = 112;

std::string definition(std::string_view name, std::string_view bytes)
{
    std::string text;
    append_base64(bytes, text);
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
