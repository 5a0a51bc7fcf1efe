#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/executor.h"
#include "partition/io/byte_writer.h"
#include "partition/io/fault_log.h"
#include "partition/io/text_scanner.h"
#include "partition/polygon_mesh.h"

/// Text mesh files of which only some lines are read, or written.
namespace seamflow {

/// Counts up to a place in a file.
struct TextCounts {
    /// Lines with a token after the header, where they alone give the element of a line: in OFF and PLY.
    std::int64_t n_lines = 0;
    /// Lines `v` and `vn` of OBJ.
    std::int64_t n_vertices = 0;
    std::int64_t n_normals = 0;

    TextCounts& operator+=(const TextCounts& other)
    {
        n_lines += other.n_lines;
        n_vertices += other.n_vertices;
        n_normals += other.n_normals;
        return *this;
    }
    friend bool operator==(const TextCounts&, const TextCounts&) = default;
};

/// Some consecutive slices of a file.
struct TextSlices {
    std::span<const std::string_view> bytes;
    /// The counts before each slice and after the last, in the whole file.
    std::span<const TextCounts> counts;
    /// Of the whole file.
    TextCounts all;
};

/// The result of reading one slice from its first line to its last.
struct CheckedSlice {
    /// As SlicedText::read gives it.
    PolygonMesh mesh;
    /// Faults that are noted.
    FaultLog faults{.of_faces_alone = true};
    /// A message that a vertex named by a face is missing; else empty. It counts if all other lines are without fault.
    std::string of_reference;
};

/// One file.
class SlicedText {
  public:
    SlicedText(const SlicedText&) = delete;
    SlicedText& operator=(const SlicedText&) = delete;
    virtual ~SlicedText() = default;

    /// Stands at the end of the header: the rest is cut into slices.
    [[nodiscard]] const TextScanner& after_header() const { return after_header_; }

    /// The counts before each of some consecutive slices, from 0, and in all of them.
    [[nodiscard]] virtual std::vector<TextCounts> count(std::span<const std::string_view> slices,
                                                        const Executor& exec) const = 0;

    /// How many vertices precede a place; with the counts of the whole file, how many it must have.
    [[nodiscard]] virtual std::int64_t n_vertices_before(const TextCounts& counts) const = 0;
    [[nodiscard]] virtual std::int64_t n_vertices(const TextCounts& all) const = 0;

    /// The vertices of some slices, and their faces with corners numbered in the whole file.
    /// @throws InputError if there is any fault in them or in the counts, not necessarily naming it (see `check`).
    [[nodiscard]] virtual PolygonMesh read(const TextSlices& slices, const Executor& exec) const = 0;

    /// Reads one slice as in reading the whole file while noting faults of faces and rows.
    /// @param scanner of the slice, with the number of its first line. @param slices this one only.
    /// @throws InputError naming the line.
    virtual void check(const TextScanner& scanner, const TextSlices& slices, CheckedSlice& found) const = 0;

    /// Whether the header's types can hold the coordinates x, y and z of all these positions.
    [[nodiscard]] virtual std::array<bool, 3> coordinates_fit(const Points&) const { return {true, true, true}; }

    /// Rewrites the header.
    /// @param fits see coordinates_fit, of all vertices. @param all of the whole file.
    /// @returns remarks for the user on it and on normals, in sentences.
    virtual std::vector<std::string> rewrite_header(ByteWriter& file, std::string_view header,
                                                    const std::array<bool, 3>& fits, const TextCounts& all) const = 0;

    /// Rewrites one of some slices with other positions; everything else stays.
    /// @param positions of the vertices of all of the slices.
    virtual void rewrite(ByteWriter& file, const TextSlices& slices, Index slice, const Points& positions) const = 0;

  protected:
    explicit SlicedText(const TextScanner& after_header)
        : after_header_(after_header)
    {
    }

    /// The number of the first vertex of some slices in the whole file.
    [[nodiscard]] Index first_vertex(const TextSlices& slices) const
    {
        return static_cast<Index>(n_vertices_before(slices.counts.front()));
    }

    /// Whether a slice is the last of the file.
    [[nodiscard]] bool is_last(std::string_view slice) const
    {
        const std::string_view rest = after_header_.rest();
        return slice.data() + slice.size() == rest.data() + rest.size();
    }

  private:
    TextScanner after_header_;
};

/// Reads the header of a file.
/// @param path for messages only. @param text must outlive the result.
/// @throws InputError as a reader of the whole file does.
std::unique_ptr<SlicedText> slice_obj_text(const std::filesystem::path& path, std::string_view text);
std::unique_ptr<SlicedText> slice_off_text(const std::filesystem::path& path, std::string_view text);
std::unique_ptr<SlicedText> slice_ply_text(const std::filesystem::path& path, std::string_view text);

}  // namespace seamflow
