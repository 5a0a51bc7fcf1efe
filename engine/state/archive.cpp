#include "engine/state/archive.h"

#include <algorithm>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// Must be increased whenever `fields` or the checksum changes.
constexpr std::uint32_t format = 0x5ea30005;

}  // namespace

void refuse_archive(const std::filesystem::path& file, const std::string& reason)
{
    throw InputError(file.string() + ": " + reason + "; remove it to start over");
}

ArchiveWriter::ArchiveWriter(const std::filesystem::path& path, std::string_view line)
    : file_(path)
{
    numbers(std::span(line));
    number(format);
}

ArchiveReader::ArchiveReader(const std::filesystem::path& path, std::string_view line,
                             std::optional<std::uint64_t> expected)
    : path_(path)
    , file_(path, std::ios::binary | std::ios::ate)
{
    if (!file_)
        refuse_archive(path, "cannot be opened");
    n_left_ = static_cast<std::uint64_t>(std::max<std::streamoff>(file_.tellg(), 0));
    file_.seekg(0);
    const std::size_t n_before = line.size() + sizeof format;
    std::string line_there(line.size(), ' ');
    if (n_left_ >= n_before + sizeof(std::uint64_t))
        numbers(std::span(line_there));
    if (line_there != line)
        refuse_archive(path, "is not a checkpoint, or only the beginning of one");
    std::uint32_t format_there = 0;
    number(format_there);
    if (format_there != format)
        refuse_archive(path, "was written by another version of this program, or on another kind of machine");
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(line)));
    checksum.add_numbers(std::span<const std::uint32_t>(&format_there, 1));
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
    if (expected.value_or(checksum_there) != checksum_there)
        refuse_archive(path, "does not belong to the others");
    file_.seekg(static_cast<std::streamoff>(n_before));
    n_left_ = n_bytes;
}

}  // namespace seamflow
