#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/stl.h"
#include "partition/formats/stl_facets.h"
#include "partition/formats/stl_scan.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"
#include "partition/text.h"

namespace seamflow {

namespace {

constexpr std::size_t title_bytes = 80;
constexpr std::size_t header_bytes = stl_header_bytes;
constexpr std::size_t normal_bytes = 12;
constexpr std::size_t attribute_bytes = 2;
constexpr std::size_t facet_bytes = stl_facet_bytes;

using Corner = std::array<float, 3>;
using BinaryFacets = FacetCollector<float>;

std::uint64_t declared_facets(std::string_view file)
{
    return from_bytes<std::uint32_t>(file.data() + title_bytes, std::endian::little);
}

/// Reads a coordinate. One that is not finite is a fault, and is returned if faults are collected.
float read_coordinate(ByteScanner& scanner)
{
    const auto value = scanner.read<float>();
    if (!std::isfinite(value))
        scanner.fault("a coordinate is not a finite number; remove the facet or mend it");
    return value;
}

Corner read_point(ByteScanner& scanner)
{
    const float x = read_coordinate(scanner);
    const float y = read_coordinate(scanner);
    const float z = read_coordinate(scanner);
    return {x, y, z};
}

/// The corners of a facet within the file; nothing if the sum of their coordinates is not finite: if a coordinate is
/// not finite, or several are huge.
std::optional<std::array<Corner, 3>> corners_of(std::string_view facet)
{
    std::array<Corner, 3> corners;
    float sum = 0.0F;
    const char* bytes = facet.data() + normal_bytes;
    for (Corner& corner : corners)
        for (float& x : corner) {
            x = from_bytes<float>(bytes, std::endian::little);
            sum += std::abs(x);
            bytes += sizeof(float);
        }
    return std::isfinite(sum) ? std::optional(corners) : std::nullopt;
}

/// Checks that the file is long enough for the facets that it declares.
void require_room_for_facets(ByteScanner& scanner, std::string_view file)
{
    if (file.size() < header_bytes)
        scanner.fail("this is neither text STL, which begins with the word solid, nor binary STL, which has at least "
                     "84 bytes; export the mesh again");
    const std::uint64_t n = declared_facets(file);
    if (n > (file.size() - header_bytes) / facet_bytes)
        scanner.fail("the file announces {}, but its {} bytes hold only {}; it has been cut off or is not "
                     "an STL file: export or copy the mesh again",
                     counted(n, "facet", "facets"), file.size(), (file.size() - header_bytes) / facet_bytes);
}

/// Reads the facets begin to end - 1.
void read_facets(ByteScanner& scanner, std::uint64_t begin, std::uint64_t end, BinaryFacets& collector)
{
    for (std::uint64_t f = begin; f < end; ++f) {
        scanner.enter("facet", f);
        // Finite facets are read at once; others number by number, which reports the coordinate at fault.
        if (scanner.remaining() >= facet_bytes)
            if (const auto corners = corners_of(scanner.peek(facet_bytes))) {
                scanner.take(facet_bytes);
                collector.add(*corners);
                continue;
            }
        scanner.take(normal_bytes);
        const Corner a = read_point(scanner);
        const Corner b = read_point(scanner);
        const Corner c = read_point(scanner);
        scanner.take(attribute_bytes);
        collector.add({a, b, c});
    }
}

/// Reads a binary file.
/// @param per_slice the number of facets of a slice. @param faults if not null, collects faults instead of throwing.
/// @throws InputError for a fault that `faults` does not collect; the message names it if all facets are in one slice.
PolygonMesh read_binary(const std::filesystem::path& path, std::string_view file, std::uint64_t per_slice,
                        const Executor& exec, FaultLog* faults)
{
    ByteScanner all(path, file, std::min(title_bytes, file.size()), std::endian::little);
    require_room_for_facets(all, file);
    const std::uint64_t n = all.read<std::uint32_t>();
    const std::uint64_t n_slices = std::max<std::uint64_t>((n + per_slice - 1) / per_slice, 1);
    return join_facets<float>(static_cast<Index>(n_slices), exec, [&](Index i, const MeshSlice& mesh_slice) {
        const std::uint64_t begin = usize(i) * per_slice;
        const std::uint64_t end = std::min(begin + per_slice, n);
        ByteScanner scanner(path, file, header_bytes + facet_bytes * begin, std::endian::little);
        scanner.note_faults_in(faults);
        BinaryFacets collector(scanner, mesh_slice);
        collector.expect_facets(end - begin);
        mesh_slice.faces.face_offsets.reserve(end - begin + 1);
        mesh_slice.faces.face_vertices.reserve(3 * (end - begin));
        read_facets(scanner, begin, end, collector);
        if (end == n)
            scanner.require_end();
        return collector.take_points(n_slices == 1);
    });
}

bool has_size_of_binary(std::string_view file)
{
    return file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * declared_facets(file);
}

}  // namespace

bool is_text_stl(std::string_view file)
{
    if (has_size_of_binary(file))
        return false;
    TextScanner scanner({}, file.substr(0, 1024));
    const bool solid = scanner.next_line() && is_keyword(scanner.token(), "solid");
    return solid && file.substr(0, 1024).find('\0') == std::string_view::npos;
}

std::string_view stl_facets(std::string_view file)
{
    return file.substr(header_bytes, facet_bytes * declared_facets(file));
}

bool is_stl(std::string_view file)
{
    return has_size_of_binary(file) || is_text_stl(file);
}

MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing& slicing, FaultLog* faults)
{
    if (!is_text_stl(file)) {
        const auto in_one_go = [&] {
            return read_binary(path, file, std::numeric_limits<std::uint32_t>::max(), run_serially, faults);
        };
        // Longer than slices of other files, because the points that two slices have in common are looked up in both.
        const std::uint64_t per_slice = 2 * static_cast<std::uint64_t>(elements_per_slice(slicing, facet_bytes));
        const auto in_slices = [&] { return read_binary(path, file, per_slice, slicing.exec, nullptr); };
        return {file.size() <= slicing.bytes ? in_one_go() : read_in_slices_if_faultless(in_slices, in_one_go),
                {FileFormat::Stl, Encoding::BinaryLittleEndian}};
    }
    return {read_text_stl(path, file, slicing, faults), {FileFormat::Stl, Encoding::Ascii}};
}

}  // namespace seamflow
