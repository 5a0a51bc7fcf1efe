#include "partition/io/shared_output.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace seamflow {

SharedOutput::SharedOutput(const std::filesystem::path& path)
    : path_(path)
    , made_(std::make_unique<OutputFile>(path, OutputFile::Naming::AtOnce))
{
}

SharedOutput::SharedOutput(const std::filesystem::path& path, const std::filesystem::path& temporary)
    : path_(path)
    , descriptor_(::open(temporary.c_str(), O_WRONLY | O_CLOEXEC))
{
    if (descriptor_ < 0)
        fail_to_write(path_, errno);
}

SharedOutput::~SharedOutput()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

void SharedOutput::write(std::string_view bytes, std::size_t offset) const
{
    if (made_ != nullptr)
        return made_->write_at(bytes, offset);
    while (!bytes.empty()) {
        const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno != EINTR)
            fail_to_write(path_, errno);
        offset += n > 0 ? static_cast<std::size_t>(n) : 0;
        bytes.remove_prefix(n > 0 ? static_cast<std::size_t>(n) : 0);
    }
}

void SharedOutput::finish()
{
    if (descriptor_ < 0)
        return;
    const bool is_on_disk = ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
    const int error = errno;
    const bool is_closed = ::close(std::exchange(descriptor_, -1)) == 0;
    if (!is_on_disk || !is_closed)
        fail_to_write(path_, is_on_disk ? errno : error);
}

}  // namespace seamflow
