#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

#include "partition/io/output_file.h"

namespace seamflow {

/// A file that several processes write together, and that appears whole or not at all: one of them makes it under a
/// temporary name, in the folder of its target, and gives it its name in the end. If a process is killed, the temporary
/// file may remain. All functions throw OutputError naming the file.
class SharedOutput {
  public:
    /// Makes it. @param path neither `-` nor to be packed.
    explicit SharedOutput(const std::filesystem::path& path);

    /// One that another process has made.
    SharedOutput(const std::filesystem::path& path, const std::filesystem::path& temporary);
    SharedOutput(const SharedOutput&) = delete;
    SharedOutput& operator=(const SharedOutput&) = delete;
    ~SharedOutput();

    /// Its name so far; for its creator only.
    [[nodiscard]] std::filesystem::path temporary() const { return made_->temporary(); }

    void write(std::string_view bytes, std::size_t offset) const;

    /// To be called by all except its creator, when they have written.
    void finish();

    /// Gives it its name; to be called by its creator when all others have finished.
    void commit() { made_->commit(); }

  private:
    std::filesystem::path path_;
    /// Null: another process has.
    std::unique_ptr<OutputFile> made_;
    int descriptor_ = -1;
};

}  // namespace seamflow
