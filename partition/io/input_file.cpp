#include "partition/io/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "partition/errors.h"
#include "partition/io/gzip.h"

namespace seamflow {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error)
{
    throw InputError(path.string() + ": cannot be read: " + std::generic_category().message(error) +
                     "; check the name and the permissions of the file");
}

/// The type is checked before the file is opened, because opening a pipe would wait for a writer.
void require_regular(const std::filesystem::path& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
        fail(path, errno);
    if (S_ISDIR(status.st_mode))
        fail(path, EISDIR);
    if (!S_ISREG(status.st_mode))
        throw InputError(path.string() + ": is not a regular file; save the mesh in a file and name that");
    if (status.st_size == 0)
        throw InputError(path.string() + ": the file is empty; export the mesh again");
}

/// Reads bytes.
/// @returns the number of bytes read; 0 at the end.
std::size_t read_some(const std::filesystem::path& path, int descriptor, std::span<char> bytes)
{
    while (true) {
        const ssize_t n = ::read(descriptor, bytes.data(), bytes.size());
        if (n >= 0)
            return static_cast<std::size_t>(n);
        if (errno != EINTR)
            fail(path, errno);
    }
}

}  // namespace

bool is_standard_stream(const std::filesystem::path& path)
{
    return path == "-";
}

bool is_input_stream(const std::filesystem::path& path)
{
    const std::string& name = path.native();
    return is_standard_stream(path) || name == "/dev/stdin" || name.starts_with("/dev/fd/") ||
           name.starts_with("/proc/self/fd/");
}

OpenFile::OpenFile(const std::filesystem::path& path, Packing packing)
    : path_(is_standard_stream(path) ? "standard input" : path)
{
    const bool is_stream = is_input_stream(path);
    if (!is_stream)
        require_regular(path);
    descriptor_ = is_standard_stream(path) ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                           : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
        fail(path_, errno);
    if (is_stream)
        collect();
    std::array<char, 2> begin{};
    if (packing == Packing::Unpack && is_gzip({begin.data(), read(begin.data(), begin.size(), 0)}))
        unpack();
}

OpenFile::OpenFile(const std::filesystem::path& path, int descriptor)
    : path_(path)
    , descriptor_(descriptor)
{
}

OpenFile OpenFile::in_memory(const std::filesystem::path& path, std::span<const std::string_view> pieces)
{
    const int descriptor = ::memfd_create("mesh", MFD_CLOEXEC);
    if (descriptor < 0)
        fail(path, errno);
    OpenFile file(path, descriptor);
    for (const std::string_view piece : pieces)
        file.append(piece);
    return file;
}

void OpenFile::append(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
        if (n < 0 && errno != EINTR)
            fail(path_, errno);
        bytes.remove_prefix(n > 0 ? static_cast<std::size_t>(n) : 0);
    }
}

/// Reads a stream into memory.
void OpenFile::collect()
{
    OpenFile collected = in_memory(path_, {});
    std::vector<char> piece(std::size_t{1} << 18);
    while (const std::size_t n = read_some(path_, descriptor_, piece))
        collected.append({piece.data(), n});
    take_content(collected);
}

void OpenFile::unpack()
{
    OpenFile unpacked = in_memory(path_, {});
    unpack_gzip(path_, InputFile(*this).content(), [&](std::string_view piece) { unpacked.append(piece); });
    take_content(unpacked);
}

/// Exchanges the content for that of another file. @throws InputError if the new content is empty.
void OpenFile::take_content(OpenFile& other)
{
    std::swap(descriptor_, other.descriptor_);
    if (size() == 0)
        throw InputError(path_.string() + ": there is nothing in it; export the mesh again");
}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : path_(std::move(other.path_))
    , descriptor_(std::exchange(other.descriptor_, -1))
{
}

OpenFile::~OpenFile()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

std::size_t OpenFile::size() const
{
    struct stat status = {};
    if (::fstat(descriptor_, &status) != 0)
        fail(path_, errno);
    return static_cast<std::size_t>(status.st_size);
}

std::size_t OpenFile::read(char* bytes, std::size_t n, std::size_t offset) const
{
    while (true) {
        const ssize_t done = ::pread(descriptor_, bytes, n, static_cast<off_t>(offset));
        if (done >= 0)
            return static_cast<std::size_t>(done);
        if (errno != EINTR)
            fail(path_, errno);
    }
}

const char* OpenFile::map(std::size_t n) const
{
    void* const mapped = ::mmap(nullptr, n, PROT_READ, MAP_PRIVATE, descriptor_, 0);
    if (mapped == MAP_FAILED)
        return nullptr;
    static_cast<void>(::madvise(mapped, n, MADV_SEQUENTIAL));
    return static_cast<const char*>(mapped);
}

InputFile::InputFile(const OpenFile& file)
{
    const std::size_t expected = file.size();
    constexpr std::size_t worth_mapping = std::size_t{1} << 20;
    if (expected >= worth_mapping)
        mapped_ = file.map(expected);
    if (mapped_ != nullptr) {
        size_ = expected;
        return;
    }
    bytes_ = std::make_unique_for_overwrite<char[]>(expected);
    constexpr std::size_t block = std::size_t{1} << 26;
    while (size_ < expected) {
        const std::size_t n = file.read(bytes_.get() + size_, std::min(block, expected - size_), size_);
        if (n == 0)
            break;
        size_ += n;
    }
}

InputFile::InputFile(InputFile&& other) noexcept
    : mapped_(std::exchange(other.mapped_, nullptr))
    , bytes_(std::move(other.bytes_))
    , size_(std::exchange(other.size_, 0))
{
}

InputFile::~InputFile()
{
    if (mapped_ != nullptr)
        ::munmap(const_cast<char*>(mapped_), size_);
}

}  // namespace seamflow
