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

    /// Draws what belongs to the table NAME.csv; nothing without Matplotlib.
    /// @throws OutputError if that fails.
    void draw(const std::string& name) const;

    /// Without Matplotlib, how to come to the pictures, in a sentence; else empty.
    [[nodiscard]] std::string remark() const;

  private:
    std::filesystem::path script_;
    /// The file of the program; empty: there is none with Matplotlib.
    std::string python_;
};

}  // namespace seamflow
