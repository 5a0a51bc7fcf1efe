#include "engine/state/archive.h"

#include <algorithm>

#include "partition/errors.h"
#include "partition/version.h"

namespace seamflow {

namespace {

/// The format of archives. To be increased whenever `fields` or the checksum changes.
constexpr std::uint32_t format = 0x5ea30007;

/// The beginning of a file.
std::string header_of(std::string_view line)
{
    std::string header(line);
    header.append(reinterpret_cast<const char*>(&format), sizeof format);
    return header.append(version).append("\n");
}

}  // namespace

void refuse_archive(const std::filesystem::path& file, const std::string& reason)
{
    throw InputError(file.string() + ": " + reason + "; remove it to start over");
}

ArchiveWriter::ArchiveWriter(const std::filesystem::path& path, std::string_view line)
    : file_(path)
{
    numbers(std::span<const char>(header_of(line)));
}

ArchiveReader::ArchiveReader(const std::filesystem::path& path, std::string_view line)
    : path_(path)
    , file_(path, std::ios::binary | std::ios::ate)
{
    if (!file_)
        refuse_archive(path, "cannot be opened");
    n_left_ = static_cast<std::uint64_t>(std::max<std::streamoff>(file_.tellg(), 0));
    file_.seekg(0);
    const std::string header = header_of(line);
    std::string header_there(header.size(), ' ');
    if (n_left_ >= header.size() + sizeof(std::uint64_t))
        numbers(std::span(header_there));
    if (!header_there.starts_with(line))
        refuse_archive(path, "is not a checkpoint, or only the beginning of one");
    if (header_there != header)
        refuse_archive(path, "was written by another version of this program, or on another kind of machine");
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(header)));
    const std::uint64_t n_bytes = n_left_ - sizeof(std::uint64_t);
    std::vector<char> portion(std::size_t{1} << 20);
    while (n_left_ > sizeof(std::uint64_t)) {
        const auto bytes = std::span(portion).first(
            static_cast<std::size_t>(std::min<std::uint64_t>(n_left_ - sizeof(std::uint64_t), portion.size())));
        numbers(bytes);
        checksum.add(std::as_bytes(bytes));
    }
    std::uint64_t checksum_there = 0;
    number(checksum_there);
    if (checksum_there != checksum.value())
        refuse_archive(path, "is damaged: it is not as it was written");
    file_.seekg(static_cast<std::streamoff>(header.size()));
    n_left_ = n_bytes;
}

}  // namespace seamflow
