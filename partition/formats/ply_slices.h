#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// Consecutive elements of a PLY file. Elements of all kinds are counted together, from 0.
struct PlySlice {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::string_view bytes = {};
};

/// Slices the data after the header.
/// @param file the whole file. @param after_header stands at the last line of the header.
/// @param elements the first ones of the header; in a text file the slices go on to its end.
/// @returns one slice at least, an empty one if there are no elements.
/// @throws InputError if a binary file lacks some of them.
std::vector<PlySlice> slice_ply(std::string_view file, const TextScanner& after_header, Encoding encoding,
                                std::span<const PlyElement> elements, const Slicing& slicing);

/// Cuts the elements of a binary file into slices.
/// @param begin the byte at which the first of them begins. @param elements see slice_ply.
/// @returns see slice_ply.
/// @throws InputError if some are missing.
std::vector<PlySlice> slice_elements(std::string_view file, std::size_t begin, Encoding encoding,
                                     std::span<const PlyElement> elements, const Slicing& slicing);

/// Whether a binary file has all elements from `begin` on, and only padding after them.
bool are_all_elements(std::string_view file, std::size_t begin, const PlyHeader& header);

/// Skips n elements of one kind in a binary file.
/// @param offset the byte at which the first of them begins.
/// @returns where the last one ends.
/// @throws InputError, with no useful message, if some are missing.
std::size_t pass_over_elements(std::string_view file, std::size_t offset, std::endian order, const PlyElement& element,
                               std::uint64_t n);

/// How many of the first `end` elements of a file have that name.
std::uint64_t count_before(std::uint64_t end, const PlyHeader& header, std::string_view name);

/// Calls `act` with every kind of elements in a slice and the numbers, within the kind, of the first element and the
/// one after the last.
void for_each_kind(std::span<const PlyElement> elements, const PlySlice& slice, const auto& act)
{
    std::uint64_t first = 0;
    for (const PlyElement& element : elements) {
        const std::uint64_t begin = std::max(slice.begin, first);
        const std::uint64_t end = std::min(slice.end, first + element.count);
        if (begin < end)
            act(element, begin - first, end - first);
        first += element.count;
    }
}

}  // namespace seamflow
