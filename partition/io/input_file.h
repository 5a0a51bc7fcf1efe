#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace seamflow {

/// Whether a path is `-`, which stands for standard input or output.
bool is_standard_stream(const std::filesystem::path& path);

/// Whether a path names something already open, perhaps a pipe: `-`, /dev/stdin, or a shell's substitute for
/// <(command). It has no name that could determine the format, and can be read only once.
bool is_input_stream(const std::filesystem::path& path);

/// A regular file, open for reading: its content can be read even after it was renamed, replaced or removed. A file
/// compressed by gzip (whatever its name) is unpacked first, and a stream (see is_input_stream) is collected, both in
/// memory.
class OpenFile {
  public:
    /// Whether a gzip file is unpacked.
    enum class Packing { Unpack, Keep };

    /// @param path `-` for standard input.
    /// @throws InputError naming the file and the system's reason; also if it is empty, or not a regular file.
    explicit OpenFile(const std::filesystem::path& path, Packing packing = Packing::Unpack);

    /// A file made of pieces of content in memory, one after the other.
    /// @param path for messages only.
    /// @throws InputError
    static OpenFile in_memory(const std::filesystem::path& path, std::span<const std::string_view> pieces);

    OpenFile(OpenFile&& other) noexcept;
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(OpenFile&&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile();

    /// The path with which the file was opened, for messages; "standard input" for `-`.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// The present size, in bytes.
    /// @throws InputError
    [[nodiscard]] std::size_t size() const;

    /// Maps the first n bytes into memory, for reading from front to back.
    /// @returns null if the system cannot map them.
    [[nodiscard]] const char* map(std::size_t n) const;

    /// Reads n bytes from `offset` on, or a few less; 0 at the end of the file.
    /// @throws InputError
    std::size_t read(char* bytes, std::size_t n, std::size_t offset) const;

  private:
    OpenFile(const std::filesystem::path& path, int descriptor);
    void append(std::string_view bytes);
    void collect();
    void unpack();
    void take_content(OpenFile& other);

    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// The content of a whole file in memory. A large file is mapped: if another program truncates it meanwhile, this
/// process ends.
class InputFile {
  public:
    /// @throws InputError
    explicit InputFile(const OpenFile& file);
    InputFile(InputFile&& other) noexcept;
    InputFile(const InputFile&) = delete;
    InputFile& operator=(InputFile&&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    /// The bytes of the file; valid as long as this object.
    [[nodiscard]] std::string_view content() const { return {mapped_ != nullptr ? mapped_ : bytes_.get(), size_}; }

  private:
    /// Null: the content is in `bytes_`.
    const char* mapped_ = nullptr;
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
};

}  // namespace seamflow
