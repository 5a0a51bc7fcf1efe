// A library that is loaded before a program's own ones (LD_PRELOAD) and makes one of its calls of the system fail, as a
// full disk or a broken one would. The program itself knows nothing of it. The environment says what fails:
//
//     FAIL_UNDER  the folder whose files are meant; those of the system and its libraries are left alone
//     FAIL_CALL   open, write, fsync, close, linkat, rename or read
//     FAIL_AT     which of these calls, from 1
//     FAIL_WITH   the error's number
//     FAIL_NOTE   a file that is made when the call fails, so that a test knows that it did
//     NO_TMPFILE  set: files without a name are refused, as some file systems do
//     SHORT       set: calls that read or write do so with a few bytes only, as they may

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdlib>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

constexpr std::size_t few_bytes = 10'000;

std::string_view setting(const char* name)
{
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

/// The same function of the C library.
template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_meant(const char* path)
{
    return !setting("FAIL_UNDER").empty() && std::string_view(path).starts_with(setting("FAIL_UNDER"));
}

/// Regular files alone.
bool is_meant(int descriptor)
{
    struct stat status = {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    char path[PATH_MAX + 1] = {};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    return ::readlink(link.c_str(), path, PATH_MAX) > 0 && is_meant(path);
}

bool is_for_writing(int descriptor)
{
    return (::fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

/// Whether this is the call that fails; errno is set then.
bool fails(std::string_view call)
{
    static std::atomic<int> n_calls = 0;
    if (call != setting("FAIL_CALL") || ++n_calls != std::atoi(setting("FAIL_AT").data()))
        return false;
    const std::string note(setting("FAIL_NOTE"));
    ::syscall(SYS_close, ::syscall(SYS_openat, AT_FDCWD, note.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
    errno = std::atoi(setting("FAIL_WITH").data());
    return true;
}

std::size_t shortened(std::size_t n)
{
    return setting("SHORT").empty() || n < few_bytes ? n : few_bytes;
}

}  // namespace

extern "C" {

// Relative names of the programs under test are names in the folder that is meant.
int open(const char* path, int flags, ...)
{
    std::va_list further;
    va_start(further, flags);
    const mode_t mode = va_arg(further, mode_t);
    va_end(further);
    const bool writes = (flags & O_ACCMODE) != O_RDONLY && (path[0] != '/' || is_meant(path));
    if (writes && (flags & O_TMPFILE) == O_TMPFILE && !setting("NO_TMPFILE").empty()) {
        errno = EOPNOTSUPP;
        return -1;
    }
    if (writes && fails("open"))
        return -1;
    return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, std::size_t n)
{
    if (is_meant(descriptor)) {
        if (fails("write"))
            return -1;
        n = shortened(n);
    }
    return next<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, n);
}

ssize_t pwrite(int descriptor, const void* bytes, std::size_t n, off_t offset)
{
    if (is_meant(descriptor)) {
        if (fails("write"))
            return -1;
        n = shortened(n);
    }
    return next<ssize_t(int, const void*, std::size_t, off_t)>("pwrite")(descriptor, bytes, n, offset);
}

ssize_t writev(int descriptor, const iovec* pieces, int n)
{
    if (is_meant(descriptor) && fails("write"))
        return -1;
    return next<ssize_t(int, const iovec*, int)>("writev")(descriptor, pieces, n);
}

int fsync(int descriptor)
{
    if (is_meant(descriptor) && fails("fsync"))
        return -1;
    return next<int(int)>("fsync")(descriptor);
}

int close(int descriptor)
{
    const bool is_failing = is_meant(descriptor) && is_for_writing(descriptor) && fails("close");
    const int error = errno;
    const int status = next<int(int)>("close")(descriptor);
    if (!is_failing)
        return status;
    errno = error;
    return -1;
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags)
{
    if (fails("linkat"))
        return -1;
    return next<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from, to_folder, to, flags);
}

int rename(const char* from, const char* to)
{
    if (fails("rename"))
        return -1;
    return next<int(const char*, const char*)>("rename")(from, to);
}

ssize_t read(int descriptor, void* bytes, std::size_t n)
{
    if (is_meant(descriptor)) {
        if (fails("read"))
            return -1;
        n = shortened(n);
    }
    return next<ssize_t(int, void*, std::size_t)>("read")(descriptor, bytes, n);
}

ssize_t pread(int descriptor, void* bytes, std::size_t n, off_t offset)
{
    if (is_meant(descriptor)) {
        if (fails("read"))
            return -1;
        n = shortened(n);
    }
    return next<ssize_t(int, void*, std::size_t, off_t)>("pread")(descriptor, bytes, n, offset);
}

}  // extern "C"
