#pragma once

#include <filesystem>

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// A folder for temporary files, in which the processes of a benchmark exchange data. It is removed with this object,
/// or when the program is stopped by SIGHUP, SIGINT or SIGTERM. Only one object at a time.
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

/// The files of such a folder; numbers are stored as they are in memory. A whole run has its own files there: input and
/// output as .obj or .ply, and report.json. Writing throws OutputError naming the file, reading InputError.
void write_mesh_for_methods(const std::filesystem::path& folder, const PolygonMesh& mesh);
PolygonMesh read_mesh_for_methods(const std::filesystem::path& folder);
void write_task(const std::filesystem::path& folder, const MethodTask& task);
MethodTask read_task(const std::filesystem::path& folder);
void write_result(const std::filesystem::path& folder, const MethodResult& result);
MethodResult read_result(const std::filesystem::path& folder);

}  // namespace seamflow
