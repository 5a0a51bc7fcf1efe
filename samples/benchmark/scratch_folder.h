#pragma once

#include <filesystem>

namespace seamflow {

/// A folder for temporary files, in which the processes of a benchmark exchange data: input.EXT and output.EXT in the
/// format of a mesh, task, result and report.json. It is removed with this object, or when the program is
/// stopped by SIGHUP, SIGINT or SIGTERM. Only one object at a time.
class ScratchFolder {
  public:
    /// @throws OutputError if no folder can be made where temporary files belong (TMPDIR).
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace seamflow
