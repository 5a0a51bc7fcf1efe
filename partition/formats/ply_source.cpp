#include "partition/formats/ply_source.h"

#include <bit>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "partition/io/slices.h"

namespace seamflow {

void PlyTextSource::begin_element(const PlyElement& element, std::uint64_t i)
{
    if (!scanner_.next_line())
        scanner_.fail(fmt::format("the file ends after {} of {} elements {}; it has been cut off, or the header is "
                                  "wrong: export or copy the mesh again",
                                  i, element.count, in_quotes(element.name)));
}

bool breaks_lines_freely(const TextScanner& after_header, const PlyHeader& header)
{
    const std::string_view all = after_header.rest();
    return static_cast<std::uint64_t>(count_lines(after_header, {&all, 1}, run_serially).back()) != header.n_elements();
}

void PlyTextSource::end_element()
{
    if (scanner_.crosses_lines() || !scanner_.has_token())
        return;
    scanner_.harmless_fault("the line continues with " + in_quotes(scanner_.peek()) +
                            " after all the properties that the header declares; correct the header or the line");
    scanner_.pass_over_rest();
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
        scanner_.fail(
            "the file continues after all the elements that its header announces; correct the counts in the header");
}

PlyBinarySource::PlyBinarySource(const std::filesystem::path& path, std::string_view file, std::size_t begin,
                                 Encoding encoding)
    : scanner_(path, file, begin, order_of(encoding))
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
    return with_type(type, [&](auto zero) { return static_cast<double>(scanner_.read<decltype(zero)>()); });
}

double PlyBinarySource::field(PlyType type, const char* name)
{
    const double value = number(type);
    if (std::isinf(value))
        scanner_.fail(fmt::format("{} is infinite; write a finite number, or NaN where there is none", name));
    return value;
}

std::int64_t PlyBinarySource::integer(PlyType type)
{
    if (!is_integer(type))
        scanner_.fail("a number that should be whole has a type with decimals; correct the header");
    return with_type(type, [&](auto zero) { return static_cast<std::int64_t>(scanner_.read<decltype(zero)>()); });
}

void PlyBinarySource::pass_over(PlyType type, std::int64_t n)
{
    require_room(type, n);
    scanner_.take(static_cast<std::size_t>(n) * size_in_bytes(type));
}

void PlyBinarySource::require_room(PlyType type, std::int64_t n) const
{
    if (static_cast<std::uint64_t>(n) > scanner_.remaining() / size_in_bytes(type))
        scanner_.fail(fmt::format("a list of {} numbers goes past the end of the file; it has been cut off, or the "
                                  "length is wrong: export or copy the mesh again",
                                  n));
}

}  // namespace seamflow
