#pragma once

#include <filesystem>
#include <string>

namespace seamflow {

/// Draws curves and surfaces from the tables and meshes of a folder by samples/figures/draw.py, which it leaves there:
/// with Matplotlib, or, where there is none, later by the user.
class Drawing {
  public:
    /// Writes draw.py, and looks for a python3 with Matplotlib on the PATH.
    /// @throws OutputError naming the file.
    explicit Drawing(const std::filesystem::path& folder);

    /// Draws what belongs to the table NAME.csv. Without Matplotlib it removes what an earlier run drew there.
    /// @throws OutputError if that fails.
    void draw(const std::string& name) const;

    /// Without Matplotlib, how to come to the pictures, for a terminal and for a page in the folder; else empty.
    [[nodiscard]] std::string remark() const;
    [[nodiscard]] std::string remark_on_page() const;

  private:
    void remove_pictures(const std::string& name) const;
    [[nodiscard]] std::string remark_with(const std::string& command) const;

    std::filesystem::path script_;
    /// The file of the program; empty: there is none with Matplotlib.
    std::string python_;
};

}  // namespace seamflow
