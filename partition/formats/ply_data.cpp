#include "partition/formats/ply_data.h"

#include <utility>

namespace seamflow {

namespace {

/// The approximate number of bytes of an element in a binary file, with lists of three numbers.
std::size_t typical_bytes(const PlyElement& element)
{
    std::size_t n = 0;
    for (const PlyProperty& property : element.properties)
        n += property.length_type ? 1 + 3 * size_in_bytes(property.type) : size_in_bytes(property.type);
    return std::max<std::size_t>(n, 1);
}

/// The slices of a text file; one slice that crosses lines if the file does not have one line per element.
std::vector<PlySlice> slice_text(const PlyData& data, const Slicing& slicing)
{
    const std::vector<std::string_view> bytes = data.after_header.slices(slicing.bytes);
    const std::vector<std::int64_t> first = count_lines(data.after_header, bytes, slicing.exec);
    const std::uint64_t n = data.header.n_elements();
    if (static_cast<std::uint64_t>(first.back()) != n)
        return {{0, n, data.bytes, true}};
    std::vector<PlySlice> slices;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        slices.push_back({static_cast<std::uint64_t>(first[i]), static_cast<std::uint64_t>(first[i + 1]), bytes[i]});
    return slices;
}

}  // namespace

PlyData ply_data_of(const std::filesystem::path& path, std::string_view file, PlyUse use)
{
    TextScanner scanner(path, file, ply_syntax);
    PlyHeader header = read_ply_header(scanner);
    return {path, file, scanner, std::move(header), scanner.rest(), use};
}

PlySlice PlyData::whole() const
{
    PlySlice slice{0, header.n_elements(), bytes};
    slice.crosses_lines =
        header.encoding == Encoding::Ascii &&
        static_cast<std::uint64_t>(count_lines(after_header, {&bytes, 1}, run_serially).back()) != slice.end;
    return slice;
}

std::vector<PlySlice> PlyData::slices(std::span<const PlyElement> kinds, const Slicing& slicing) const
{
    std::vector<PlySlice> slices;
    if (header.encoding == Encoding::Ascii)
        slices = slice_text(*this, slicing);
    else
        for (PlySource numbers = source({.bytes = bytes}); const PlyElement& kind : kinds) {
            const std::uint64_t n_before = slices.empty() ? 0 : slices.back().end;
            const std::uint64_t per_slice = usize(elements_per_slice(slicing, typical_bytes(kind)));
            for (std::uint64_t i = 0; i < kind.count;) {
                const char* const begin = numbers.behind().data();
                const std::uint64_t end = i + std::min(per_slice, kind.count - i);
                numbers.pass_over(kind, i, end);
                slices.push_back({n_before + i, n_before + end, {begin, numbers.behind().data()}});
                i = end;
            }
        }
    if (slices.empty())
        slices.push_back({0, 0, bytes.substr(0, 0)});
    return slices;
}

PlySource PlyData::source(const PlySlice& slice) const
{
    const char* const what = use == PlyUse::Mesh ? "mesh" : "file";
    if (header.encoding != Encoding::Ascii) {
        const auto begin = static_cast<std::size_t>(slice.bytes.data() - file.data());
        return {ByteScanner(path, file, begin, order_of(header.encoding)), what};
    }
    TextScanner scanner(after_header, slice.bytes, after_header.line());
    if (slice.crosses_lines)
        scanner.cross_lines();
    return {scanner, what};
}

}  // namespace seamflow
