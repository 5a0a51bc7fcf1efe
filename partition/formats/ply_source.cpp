#include "partition/formats/ply_source.h"

#include <bit>
#include <cmath>
#include <string>

namespace seamflow {

void PlyTextSource::begin_element(const PlyElement& element, std::uint64_t i)
{
    if (!scanner_.next_line())
        scanner_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(element.count) +
                      " elements " + in_quotes(element.name) +
                      "; it has been cut off, or the header is wrong: export or copy the mesh again");
}

void PlyTextSource::end_element()
{
    if (scanner_.has_token())
        scanner_.fail("the line goes on with " + in_quotes(scanner_.peek()) +
                      " after all the properties that the header declares; correct the header or the line");
}

void PlyTextSource::pass_over(PlyType, std::int64_t n)
{
    for (; n > 0; --n)
        if (scanner_.token().empty())
            scanner_.fail("the line has fewer numbers than the header declares; add what is missing or export the mesh "
                          "again");
}

void PlyTextSource::finish()
{
    if (scanner_.next_line())
        scanner_.fail("the file goes on after all the elements that its header announces; correct the counts in the "
                      "header");
}

PlyBinarySource::PlyBinarySource(const std::filesystem::path& path, std::string_view file, std::size_t begin,
                                 Encoding encoding)
    : scanner_(path, file, begin, encoding == Encoding::BinaryBigEndian ? std::endian::big : std::endian::little)
{
}

double PlyBinarySource::real(PlyType type)
{
    const double value = number(type);
    if (!std::isfinite(value))
        scanner_.fault("a coordinate is not a finite number; remove the vertex or mend it");
    return value;
}

double PlyBinarySource::number(PlyType type)
{
    if (type == PlyType::Float64)
        return scanner_.read<double>();
    return type == PlyType::Float32 ? double{scanner_.read<float>()} : static_cast<double>(integer(type));
}

std::int64_t PlyBinarySource::integer(PlyType type)
{
    switch (type) {
    case PlyType::Int8:
        return scanner_.read<std::int8_t>();
    case PlyType::UInt8:
        return scanner_.read<std::uint8_t>();
    case PlyType::Int16:
        return scanner_.read<std::int16_t>();
    case PlyType::UInt16:
        return scanner_.read<std::uint16_t>();
    case PlyType::Int32:
        return scanner_.read<std::int32_t>();
    case PlyType::UInt32:
        return scanner_.read<std::uint32_t>();
    case PlyType::Float32:
    case PlyType::Float64:
        break;
    }
    scanner_.fail("a number that should be whole has a type with decimals; correct the header");
}

void PlyBinarySource::pass_over(PlyType type, std::int64_t n)
{
    require_room(type, n);
    scanner_.take(static_cast<std::size_t>(n) * size_in_bytes(type));
}

void PlyBinarySource::require_room(PlyType type, std::int64_t n) const
{
    if (static_cast<std::uint64_t>(n) > scanner_.remaining() / size_in_bytes(type))
        scanner_.fail("a list of " + std::to_string(n) +
                      " numbers goes past the end of the file; it has been cut off, or the length is wrong: export or "
                      "copy the mesh again");
}

}  // namespace seamflow
