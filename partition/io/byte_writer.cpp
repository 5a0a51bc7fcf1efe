#include "partition/io/byte_writer.h"

#include <algorithm>
#include <utility>

namespace seamflow {

void ByteWriter::grow(std::size_t n)
{
    const std::size_t room = std::max(used_ + n, 2 * room_);
    auto bytes = std::make_unique_for_overwrite<char[]>(room);
    std::copy_n(bytes_.get(), used_, bytes.get());
    bytes_ = std::move(bytes);
    room_ = room;
}

void OutputBuffer::overflow(std::string_view text)
{
    grow(text.size() + longest_number);
    this->text(text);
}

}  // namespace seamflow
