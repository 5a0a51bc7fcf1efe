#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "partition/formats/ply_source.h"
#include "partition/io/fault_log.h"
#include "partition/io/slices.h"

namespace seamflow {

/// Consecutive elements of a PLY file. Elements of all kinds are counted together, from 0.
struct PlySlice {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::string_view bytes = {};
    /// Whether this is a whole text file that does not have one line per element, so that line ends count as blanks.
    bool crosses_lines = false;
};

/// The purpose for which a PLY file is read.
enum class PlyUse {
    /// A mesh, or data of a mesh that has been read from the file.
    Mesh,
    /// Data for a mesh from another file.
    OtherData
};

/// The elements of a PLY file, or bytes with the same layout in a file of another format.
struct PlyData {
    /// The path of the file, for messages only.
    const std::filesystem::path& path;
    /// The whole file.
    std::string_view file;
    /// Only for a PLY file: a scanner at the last line of the header.
    TextScanner after_header;
    PlyHeader header;
    /// The content after the header.
    std::string_view bytes;
    PlyUse use = PlyUse::Mesh;

    /// All elements, as one slice.
    [[nodiscard]] PlySlice whole() const;

    /// Divides the elements of some kinds into slices; in a text file the last slice extends to the end.
    /// @param kinds the first kinds of elements in the file.
    /// @returns at least one slice, an empty one if there are no elements.
    /// @throws InputError, without a useful message, if a binary file lacks some of them.
    [[nodiscard]] std::vector<PlySlice> slices(std::span<const PlyElement> kinds, const Slicing& slicing) const;

    /// A source of the numbers of a slice. The lines in its messages are right if there is one slice.
    [[nodiscard]] PlySource source(const PlySlice& slice) const;

    /// The kinds of elements up to one of them, which is included.
    [[nodiscard]] std::span<const PlyElement> up_to(const PlyElement& kind) const
    {
        return {header.elements.data(), &kind + 1};
    }

    /// Calls `act` with every kind of elements in a slice and the numbers, within the kind, of the first element and
    /// the one after the last.
    static void for_each_kind(std::span<const PlyElement> kinds, const PlySlice& slice, const auto& act)
    {
        std::uint64_t first = 0;
        for (const PlyElement& element : kinds) {
            const std::uint64_t begin = std::max(slice.begin, first);
            const std::uint64_t end = std::min(slice.end, first + element.count);
            if (begin < end)
                act(element, begin - first, end - first);
            first += element.count;
        }
    }

    /// Reads the elements of one kind in a slice. Skips the elements before them and, in data of a mesh, faults that
    /// the reader of the mesh has accepted.
    /// @param kind the kind of elements. @param columns the column of each of its properties (see columns_of).
    /// @param read called with the source, the number of the element, the column of a property and its declaration, to
    /// read it from the source.
    /// @param act called with the source and the number of the element after its last property; end_element is called
    /// after it.
    void scan(const PlySlice& slice, const PlyElement& kind, const std::vector<Index>& columns, const auto& read,
              const auto& act) const
    {
        PlySource numbers = source(slice);
        FaultLog known_faults{.of_faces_alone = true};
        if (use == PlyUse::Mesh)
            numbers.note_faults_in(&known_faults);
        for_each_kind(up_to(kind), slice, [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
            if (&element != &kind)
                return numbers.pass_over(element, begin, end);
            numbers.scan(
                element, begin, end, columns,
                [&](Index i, Index column, const PlyProperty& property) { read(numbers, i, column, property); },
                [&](Index i) {
                    act(numbers, i);
                    numbers.end_element();
                });
        });
    }
};

/// The elements of a PLY file, after reading its header.
/// @param path for messages only; must outlive the result, as must the file.
/// @throws InputError (see read_ply_header).
PlyData ply_data_of(const std::filesystem::path& path, std::string_view file, PlyUse use = PlyUse::Mesh);

/// Reads the elements as a mesh.
/// @param data with vertices whose coordinates are single numbers. @param faults if not null, collects faults instead
/// of throwing.
/// @throws InputError naming the line, or the element and its byte.
PolygonMesh read_ply_elements(const PlyData& data, const Slicing& slicing, FaultLog* faults = nullptr);

}  // namespace seamflow
