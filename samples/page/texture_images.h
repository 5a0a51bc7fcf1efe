#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace seamflow {

/// The folder of a file; it is never empty, so that a name in it is never taken for standard input.
inline std::filesystem::path folder_of(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : ".";
}

/// The images that a mesh file names, as data URLs.
class TextureImages {
  public:
    /// @param mesh the file that names them, or a file beside it that does.
    explicit TextureImages(const std::filesystem::path& mesh)
        : folder_(folder_of(mesh))
    {
    }

    /// Reads a PNG, JPEG, WebP, GIF or BMP file, which is recognised by its first bytes.
    /// @param name as given in the mesh file, with slashes of either kind: relative to the folder of that file; else
    ///        the file of that name in this folder is used.
    /// @returns empty, with a remark, if there is none, or no browser shows it, or all are too large for a page.
    std::string data_url(const std::string& name);

    /// Sentences for the user.
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

  private:
    std::string read(const std::string& name);

    std::filesystem::path folder_;
    std::map<std::string, std::string> known_;
    std::vector<std::string> remarks_;
    std::size_t bytes_ = 0;
};

/// The type of an image that browsers show, from its first bytes; empty for any other file.
std::string_view image_type(std::string_view bytes);

}  // namespace seamflow
