#include "partition/formats/gltf_buffer_files.h"

#include <set>
#include <string>
#include <system_error>
#include <utility>

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
        // There is no such file, or it is of another kind.
    }
    return names;
}

}  // namespace

std::vector<std::filesystem::path> paths_of_gltf_buffers(const std::filesystem::path& output,
                                                         const std::filesystem::path& input, std::size_t n)
{
    const std::filesystem::path file = file_behind(output);
    std::error_code ignored;
    // A name that the replaced file gives to a buffer is used again, unless it is also that of a buffer of the input.
    std::set<std::string> replaced = names_of_buffers(output);
    for (const std::string& of_input : names_of_buffers(input))
        std::erase_if(replaced, [&](const std::string& name) {
            return std::filesystem::equivalent(file.parent_path() / name, input.parent_path() / of_input, ignored);
        });
    std::vector<std::filesystem::path> paths;
    for (int number = 1; paths.size() < n; ++number) {
        std::filesystem::path path = before_extension(file);
        path += number == 1 ? ".bin" : fmt::format("-{}.bin", number);
        if (replaced.contains(path.filename().string()) || !std::filesystem::exists(path, ignored))
            paths.push_back(std::move(path));
    }
    return paths;
}

}  // namespace seamflow
