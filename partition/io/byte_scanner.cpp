#include "partition/io/byte_scanner.h"

#include <fmt/format.h>

namespace seamflow {

ByteScanner::ByteScanner(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                         std::endian order)
    : path_(path.string())
    , file_(file)
    , order_(order)
    , last_(offset)
    , next_(offset)
{
}

void ByteScanner::require_end()
{
    element_ = {};
    last_ = next_;
    const auto left = file_.find_first_not_of(padding, next_);
    if (left == std::string_view::npos)
        return;
    last_ = left;
    fail("the file continues where its header says it should end; correct the counts in the header or export the mesh "
         "again");
}

std::string ByteScanner::position() const
{
    if (element_.empty())
        return fmt::format("{}: byte {}", path_, last_);
    return fmt::format("{}: {} {} (numbered from 0), byte {}", path_, printable(element_), i_, last_);
}

void ByteScanner::fail_at_end() const
{
    fail("the file ends too early; it has been cut off, or a number in it is wrong: export or copy the mesh again");
}

}  // namespace seamflow
