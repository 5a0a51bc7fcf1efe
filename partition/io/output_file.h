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

/// The file that a path leads to: symbolic links are followed, even to files that do not exist.
/// @returns the path of a link only if links form a cycle.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// Reports why a file could not be written.
/// @param error of the system.
/// @throws OutputError
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error);

/// A file that appears whole or not at all: written without a name, or under a temporary one where the file system
/// cannot do that, in the folder of its target, and given its name by `commit`. Without `commit` nothing remains of it,
/// and a file that was there before remains as it was. A file that is replaced hands on its permissions; a symbolic
/// link stays, and the file it points to is replaced. Where the extension is `.gz` the file is packed. All functions
/// throw OutputError if the file cannot be written.
class OutputFile final : public ByteWriter {
  public:
    /// @param path `-` for standard output, which gets everything at once and irrevocably.
    /// @throws OutputError naming the file and the system's reason; also if `path` is there but no regular file.
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    /// As it was named, for messages; "standard output" for that.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Whether it is standard output.
    [[nodiscard]] bool is_stream() const { return is_stream_; }

    /// Writes n consecutive slices, each of which `make` puts into a buffer; several are made and written at a time.
    void slices(Index n, const Executor& exec, const std::function<void(Index slice, OutputBuffer& buffer)>& make);

    /// Begins another file, which `commit` of this one writes and names with it.
    /// @pre this is not standard output.
    OutputFile& beside(const std::filesystem::path& path);

    /// Writes what is left to the disk and gives the file its name; those beside it get theirs just before. To be
    /// called once, at the end.
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
    /// Empty as long as the file has no name.
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    bool is_stream_ = false;
    /// Null: nothing is packed.
    std::unique_ptr<GzipMember> gzip_;
    /// Number of bytes handed to the system.
    std::size_t n_written_ = 0;
    std::vector<std::unique_ptr<OutputFile>> beside_;
};

}  // namespace seamflow
