#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "partition/executor.h"
#include "partition/io/byte_writer.h"
#include "partition/io/gzip.h"

namespace seamflow {

/// The file to which a path leads: symbolic links are followed, even to files that do not exist.
/// @returns the path itself if links form a cycle, or more than 40 links follow each other.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// Reports why a file could not be written.
/// @param error of the system.
/// @throws OutputError
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error);

/// A file that appears whole or not at all. It is written without a name, or under a temporary name if the file system
/// requires one, in the folder of its target; `commit` gives it its name. Without `commit` nothing of it remains, and
/// an existing file does not change. A replaced file passes on its permissions; a symbolic link stays, and the file to
/// which it points is replaced. If the extension is `.gz` the file is packed. All functions throw OutputError if the
/// file cannot be written.
class OutputFile final : public ByteWriter {
  public:
    /// @param path `-` for standard output, which gets everything at once and irrevocably.
    /// @throws OutputError naming the file and the system's reason; also if `path` exists and is no regular file.
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    /// The path with which the file was opened, for messages; "standard output" for `-`.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Whether the file is standard output.
    [[nodiscard]] bool is_stream() const { return is_stream_; }

    /// Writes n consecutive slices; `make` writes each into a buffer. Several are made and written at a time.
    void slices(Index n, const Executor& exec, const std::function<void(Index slice, OutputBuffer& buffer)>& make);

    /// Begins another file; `commit` of this file also writes and names it.
    /// @pre this is not standard output.
    OutputFile& beside(const std::filesystem::path& path);

    /// Writes all remaining data to the disk and gives the file its name; files begun by `beside` get their names just
    /// before. To be called once, at the end.
    void commit();

  private:
    [[noreturn]] void fail(int error) const;
    void open();
    void give_temporary_name();
    void finish();
    void take_name();
    void flush();
    void put(std::string_view bytes);
    void put_unpacked(std::string_view bytes);
    void write(std::string_view bytes, std::size_t offset) const;
    void overflow(std::string_view text) override;

    std::filesystem::path path_;
    std::filesystem::path target_;
    std::filesystem::path folder_;
    /// The temporary name; empty while the file has none.
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    bool is_stream_ = false;
    /// Null if nothing is packed.
    std::unique_ptr<GzipMember> gzip_;
    /// The number of bytes handed to the system.
    std::size_t n_written_ = 0;
    std::vector<std::unique_ptr<OutputFile>> beside_;
};

}  // namespace seamflow
