#include "samples/training/weights_file.h"

#include <cstddef>
#include <string_view>

#include "partition/errors.h"
#include "partition/formats/gltf_text.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

constexpr std::size_t line_width = 112;

/// The weights of a network as a paragraph of text.
std::string paragraph(std::string_view bytes)
{
    std::string text;
    append_base64(bytes, text);
    std::string lines;
    for (std::size_t i = 0; i < text.size(); i += line_width)
        lines.append(text, i, line_width) += '\n';
    return lines;
}

}  // namespace

void require_replaceable(const std::filesystem::path& path)
{
    constexpr std::string_view of_weights = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=\r\n";
    if (!std::filesystem::exists(path))
        return;
    const InputFile file{OpenFile(path)};
    if (file.content().find_first_not_of(of_weights) != std::string_view::npos)
        throw InputError(path.string() + ": the file holds no weights of networks, and is not replaced: name another");
}

std::string text_of_weights(const TrainedDenoiser& trained)
{
    std::string text;
    for (const std::string& stage : trained.stages)
        text += paragraph(stage) + "\n";
    return text + paragraph(trained.noise);
}

}  // namespace seamflow
