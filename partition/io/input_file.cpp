#include "partition/io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error)
{
    throw InputError(path.string() + ": cannot be read: " + std::generic_category().message(error) +
                     "; check the name and the permissions of the file");
}

/// An open file, closed at the end of its scope.
class Descriptor {
  public:
    explicit Descriptor(const std::filesystem::path& path)
        : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
    {
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (number_ >= 0)
            ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

/// Asked before the file is opened, for opening a pipe would wait for somebody to write into it.
std::size_t size_of(const std::filesystem::path& path)
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
    return static_cast<std::size_t>(status.st_size);
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path)
{
    const std::size_t expected = size_of(path);
    const Descriptor file(path);
    if (file.number() < 0)
        fail(path, errno);
    bytes_ = std::make_unique_for_overwrite<char[]>(expected);
    constexpr std::size_t block = std::size_t{1} << 26;
    while (size_ < expected) {
        const ssize_t n = ::read(file.number(), bytes_.get() + size_, std::min(block, expected - size_));
        if (n < 0 && errno != EINTR)
            fail(path, errno);
        if (n == 0)
            break;
        size_ += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
}

}  // namespace seamflow
