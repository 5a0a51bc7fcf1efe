#include "partition/io/output_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "partition/errors.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

std::filesystem::path folder_of(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// A name that no other file of this program has; if another program uses it, the next name is tried.
std::filesystem::path temporary_name(const std::filesystem::path& target)
{
    static std::atomic<unsigned> counter = 0;
    return folder_of(target) / fmt::format(".seamflow-{}-{}.tmp", ::getpid(), counter++);
}

/// The system's name of an open file.
std::string name_of_descriptor(int descriptor)
{
    return fmt::format("/proc/self/fd/{}", descriptor);
}

/// Opens an unnamed file, which disappears with the process, however that ends.
/// @returns -1 if the system does not support this, or could not name the file later.
int open_unnamed(const std::filesystem::path& folder)
{
#ifdef O_TMPFILE
    const int descriptor = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    if (descriptor < 0 || ::access(name_of_descriptor(descriptor).c_str(), F_OK) == 0)
        return descriptor;
    ::close(descriptor);
#endif
    return -1;
}

/// Has the system write all data of a file to the disk. A file system that does not support this is no reason to fail.
/// @returns 0, or the error of the system.
int synchronise(int descriptor)
{
    const bool done = ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
    return done ? 0 : errno;
}

/// Makes the new name of a file survive a power cut. The file is complete in any case: errors are ignored.
void synchronise_folder(const std::filesystem::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    synchronise(descriptor);
    ::close(descriptor);
}

}  // namespace

std::filesystem::path file_behind(const std::filesystem::path& path)
{
    constexpr int most_links = 40;
    std::filesystem::path file = path;
    for (int i = 0; i < most_links; ++i) {
        std::error_code error;
        const auto next = std::filesystem::read_symlink(file, error);
        if (error)
            return file;
        file = next.is_absolute() ? next : folder_of(file) / next;
    }
    return path;
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : ByteWriter(buffer_bytes)
    , path_(is_standard_stream(path) ? "standard output" : path)
    , is_stream_(is_standard_stream(path))
{
    if (is_gzip_name(path))
        gzip_ = std::make_unique<GzipMember>();
    if (is_stream_) {
        descriptor_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        if (descriptor_ < 0)
            fail(errno);
        return;
    }
    target_ = file_behind(path);
    folder_ = folder_of(target_);
    struct stat old = {};
    const bool replaces = ::stat(target_.c_str(), &old) == 0;
    if (replaces && S_ISDIR(old.st_mode))
        fail(EISDIR);
    if (replaces && !S_ISREG(old.st_mode))
        throw OutputError(path_.string() + ": is not a regular file; choose another name");
    std::error_code ignored;
    if (std::filesystem::is_symlink(target_, ignored))
        fail(ELOOP);
    open();
    if (replaces)
        static_cast<void>(::fchmod(descriptor_, old.st_mode & 07777U));
}

void OutputFile::open()
{
    descriptor_ = open_unnamed(folder_);
    if (descriptor_ >= 0)
        return;
    do {
        temporary_ = temporary_name(target_);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0)
        fail(errno);
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
    if (!temporary_.empty())
        ::unlink(temporary_.c_str());
}

void fail_to_write(const std::filesystem::path& path, int error)
{
    throw OutputError(path.string() + ": cannot be written: " + std::generic_category().message(error) +
                      "; check that the folder exists, that you may write there, and that there is room left");
}

void OutputFile::fail(int error) const
{
    fail_to_write(path_, error);
}

void OutputFile::overflow(std::string_view text)
{
    flush();
    if (text.size() > buffer_bytes)
        put(text);
    else
        this->text(text);
}

void OutputFile::flush()
{
    put(kept());
    give_up();
}

/// Appends bytes to the file, packed if its extension is `.gz`.
void OutputFile::put(std::string_view bytes)
{
    if (gzip_ == nullptr)
        return put_unpacked(bytes);
    if (n_written_ == 0)
        put_unpacked(GzipMember::head());
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), buffer_bytes))) {
        const PackedPiece piece = pack_piece(bytes.substr(0, buffer_bytes));
        gzip_->add(piece);
        put_unpacked(piece.bytes);
    }
}

/// Appends bytes to the file as they are.
void OutputFile::put_unpacked(std::string_view bytes)
{
    write(bytes, n_written_);
    n_written_ += bytes.size();
}

/// Writes bytes at an offset; at the end, whatever the offset, if the file is standard output.
void OutputFile::write(std::string_view bytes, std::size_t offset) const
{
    while (!bytes.empty()) {
        const ssize_t n = is_stream_ ? ::write(descriptor_, bytes.data(), bytes.size())
                                     : ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno != EINTR)
            fail(errno);
        offset += n > 0 ? static_cast<std::size_t>(n) : 0;
        bytes.remove_prefix(n > 0 ? static_cast<std::size_t>(n) : 0);
    }
}

void OutputFile::slices(Index n, const Executor& exec, const std::function<void(Index, OutputBuffer&)>& make)
{
    struct Slice {
        OutputBuffer made;
        OutputBuffer to_write;
        std::size_t offset = 0;
        PackedPiece packed;
    };
    flush();
    constexpr Index at_once = 32;
    std::vector<Slice> round(std::min(n, at_once));
    // Each round writes the output of the previous one, because its offset is known only then.
    for (Index begin = 0; begin < n + at_once; begin += at_once) {
        for_each(exec, static_cast<Index>(round.size()), [&](Index i) {
            Slice& slice = round[i];
            write(slice.to_write.content(), slice.offset);
            slice.to_write.clear();
            slice.packed = {};
            if (begin + i >= n)
                return;
            make(begin + i, slice.made);
            if (gzip_ != nullptr) {
                slice.packed = pack_piece(slice.made.content());
                slice.made.clear();
                slice.made.text(slice.packed.bytes);
            }
        });
        for (Slice& slice : round) {
            if (gzip_ != nullptr)
                gzip_->add(slice.packed);
            slice.offset = n_written_;
            n_written_ += slice.made.content().size();
            if (is_stream_) {
                write(slice.made.content(), 0);
                slice.made.clear();
            }
            std::swap(slice.made, slice.to_write);
        }
#ifdef SYNC_FILE_RANGE_WRITE
        // Starts writing to the disk now, so that `commit` has less to wait for.
        static_cast<void>(::sync_file_range(descriptor_, 0, 0, SYNC_FILE_RANGE_WRITE));
#endif
    }
}

/// Gives the file a temporary name, because only renaming can replace another file. After that, nothing may fail before
/// the name is recorded.
void OutputFile::give_temporary_name()
{
    const std::string source = name_of_descriptor(descriptor_);
    std::filesystem::path name;
    int status = 0;
    do {
        name = temporary_name(target_);
        status = ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    } while (status != 0 && errno == EEXIST);
    if (status != 0)
        fail(errno);
    temporary_ = std::move(name);
}

/// Writes the rest of the file to the disk and closes it under a temporary name: does everything that may fail, except
/// for renaming the file.
void OutputFile::finish()
{
    flush();
    if (gzip_ != nullptr)
        put_unpacked(gzip_->tail());
    if (is_stream_)
        return;
    if (const int error = synchronise(descriptor_); error != 0)
        fail(error);
    if (temporary_.empty())
        give_temporary_name();
    if (::close(std::exchange(descriptor_, -1)) != 0)
        fail(errno);
}

/// Renames the file, which may fail. After that the file exists and nothing may fail any more: this allocates no
/// memory.
void OutputFile::take_name()
{
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail(errno);
    temporary_.clear();
    synchronise_folder(folder_);
}

OutputFile& OutputFile::beside(const std::filesystem::path& path)
{
    return *beside_.emplace_back(std::make_unique<OutputFile>(path));
}

void OutputFile::commit()
{
    finish();
    for (const auto& other : beside_)
        other->finish();
    for (const auto& other : beside_)
        other->take_name();
    if (!is_stream_)
        take_name();
}

}  // namespace seamflow
