#include "partition/formats/mesh_file.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/gzip.h"
#include "partition/io/input_file.h"
#include "partition/text.h"

namespace seamflow {

namespace {

/// The format of a path.
/// @throws Error if the path names none.
template <class Error>
FileFormat require_format_or(const std::filesystem::path& path)
{
    if (const auto format = format_of(path))
        return *format;
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
        throw Error(fmt::format("{}: is a directory; name a file in it", path.string()));
    throw Error(fmt::format("{}: the extension '{}' is not one of {}; give the file the extension of its format",
                            path.string(), path.extension().string(), extensions_of(FormatGroup::All)));
}

}  // namespace

const FormatTraits& traits_of(FileFormat format)
{
    return format_traits[static_cast<std::size_t>(format)];
}

std::string choice_of(const std::vector<std::string_view>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text.append(i == 0 ? "" : i + 1 < words.size() ? ", " : " or ").append(words[i]);
    return text;
}

std::optional<FileFormat> format_of(const std::filesystem::path& path)
{
    const std::filesystem::path unpacked = is_gzip_name(path) ? path.stem() : path;
    const std::string extension = lower_case(unpacked.extension().string());
    const auto found = std::ranges::find(format_traits, extension, &FormatTraits::extension);
    return found != format_traits.end() ? std::optional(found->format) : std::nullopt;
}

std::filesystem::path before_extension(const std::filesystem::path& path)
{
    std::string name = path.string();
    name.resize(name.size() - path.extension().string().size());
    if (is_gzip_name(path))
        name.resize(name.size() - path.stem().extension().string().size());
    return name;
}

std::string extension_of(FileFormat format)
{
    return std::string(traits_of(format).extension);
}

std::string extensions_of(FormatGroup group)
{
    std::vector<std::string_view> extensions;
    for (const FormatTraits& format : format_traits)
        if (group == FormatGroup::All || (group == FormatGroup::Polygons && format.holds_polygons) ||
            (group == FormatGroup::Text && format.last_encoding == Encoding::Ascii))
            extensions.push_back(format.extension);
    return choice_of(extensions);
}

std::optional<FileFormat> format_of_input(const std::filesystem::path& path)
{
    if (is_input_stream(path))
        return {};
    return require_format_or<InputError>(path);
}

FileKind kind_for_writing(const std::filesystem::path& path, const FileKind& source)
{
    if (is_standard_stream(path))
        return source;
    const FormatTraits& format = traits_of(require_format_or<OptionError>(path));
    if (format.format == source.format)
        return source;
    return {format.format, std::min(Encoding::BinaryLittleEndian, format.last_encoding)};
}

}  // namespace seamflow
