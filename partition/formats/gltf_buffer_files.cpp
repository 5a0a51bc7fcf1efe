#include "partition/formats/gltf_buffer_files.h"

#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf_content.h"
#include "partition/formats/mesh_file.h"
#include "partition/io/input_file.h"
#include "partition/io/output_file.h"

namespace seamflow {

namespace {

/// The names of the buffers of a file that are other files; none if it is no glTF file.
std::set<std::string> names_of_buffers(const std::filesystem::path& path)
{
    std::set<std::string> names;
    try {
        const InputFile file{OpenFile(path)};
        const GltfContent content(path, file.content());
        for (std::size_t i = 0; i < content.n_buffers(); ++i)
            if (const GltfValue uri = content.root()["buffers"].at(i)["uri"];
                uri.is_there() && !is_gltf_data(uri.text()))
                names.insert(gltf_name_of(uri.text()));
    } catch (const InputError&) {
        // There is none, or it is another kind of file.
    }
    return names;
}

}  // namespace

GltfBufferFiles::GltfBufferFiles(const std::filesystem::path& output, const std::filesystem::path& input)
    : folder_(file_behind(output).parent_path())
    , stem_(before_extension(file_behind(output).filename()).string())
    , replaced_(names_of_buffers(output))
{
    std::error_code ignored;
    for (const std::string& of_input : names_of_buffers(input))
        std::erase_if(replaced_, [&](const std::string& name) {
            return std::filesystem::equivalent(folder_ / name, input.parent_path() / of_input, ignored);
        });
}

std::string GltfBufferFiles::next_name()
{
    std::error_code ignored;
    while (true) {
        ++n_;
        std::string name = n_ == 1 ? stem_ + ".bin" : fmt::format("{}-{}.bin", stem_, n_);
        if (replaced_.contains(name) || !std::filesystem::exists(folder_ / name, ignored))
            return name;
    }
}

}  // namespace seamflow
