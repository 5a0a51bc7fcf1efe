#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/ply_elements.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_ranges.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/formats/text_slices.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

class SlicedPly final : public SlicedText {
  public:
    SlicedPly(const std::filesystem::path& path, const TextScanner& after_header, PlyHeader header)
        : SlicedText(after_header)
        , path_(path)
        , header_(std::move(header))
    {
        for (const PlyElement& element : header_.elements)
            n_lines_ += static_cast<std::int64_t>(element.count);
    }

    [[nodiscard]] std::vector<TextCounts> count(std::span<const std::string_view> slices,
                                                const Executor& exec) const override
    {
        std::vector<TextCounts> counts;
        for (const std::int64_t n : count_lines(after_header(), slices, exec))
            counts.push_back({.n_lines = n});
        return counts;
    }

    [[nodiscard]] std::int64_t n_vertices_before(const TextCounts& counts) const override
    {
        return static_cast<std::int64_t>(count_before(static_cast<std::uint64_t>(counts.n_lines), header_, "vertex"));
    }

    [[nodiscard]] std::int64_t n_vertices(const TextCounts&) const override
    {
        return static_cast<std::int64_t>(vertices().count);
    }

    [[nodiscard]] PolygonMesh read(const TextSlices& slices, const Executor& exec) const override;
    void check(const TextScanner& scanner, const TextSlices& slices, CheckedSlice& found) const override;

    [[nodiscard]] std::array<bool, 3> coordinates_fit(const Points& positions) const override
    {
        return seamflow::coordinates_fit(vertices(), positions);
    }

    std::vector<std::string> rewrite_header(ByteWriter& file, std::string_view header, const std::array<bool, 3>& fits,
                                            const TextCounts&) const override
    {
        return rewrite_ply_header(file, path_, header, vertices(), changes_of_positions(vertices(), fits));
    }

    void rewrite(ByteWriter& file, const TextSlices& slices, Index slice, const Points& positions) const override
    {
        rewrite_ply_text(file, after_header(), header_, slice_between(slices, slice, slices.counts[slice + 1].n_lines),
                         positions, first_vertex(slices));
    }

  private:
    [[nodiscard]] const PlyElement& vertices() const { return *header_.element("vertex"); }

    static PlySlice slice_between(const TextSlices& slices, Index slice, std::int64_t end)
    {
        const std::int64_t begin = std::min(slices.counts[slice].n_lines, end);
        return {static_cast<std::uint64_t>(begin), static_cast<std::uint64_t>(end), slices.bytes[slice]};
    }

    void read_elements(PlyTextSource& source, const PlySlice& slice, const MeshSlice& place) const
    {
        ElementReader<PlyTextSource> reader(source, static_cast<Index>(vertices().count), place);
        for_each_kind(header_.elements, slice, [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
            reader.read(element, begin, end);
        });
    }

    std::filesystem::path path_;
    PlyHeader header_;
    /// One for each element.
    std::int64_t n_lines_ = 0;
};

PolygonMesh SlicedPly::read(const TextSlices& slices, const Executor& exec) const
{
    if (slices.all.n_lines != n_lines_)
        throw InputError("the file ends too early, or goes on");
    static_cast<void>(sum_of_counts(0, n_vertices(slices.all)));
    const Index first = first_vertex(slices);
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(static_cast<Index>(n_vertices_before(slices.counts.back())) - first);
    const auto n_faces = count_before(static_cast<std::uint64_t>(slices.counts.back().n_lines), header_, "face") -
                         count_before(static_cast<std::uint64_t>(slices.counts.front().n_lines), header_, "face");
    mesh.face_offsets.reserve(n_faces + 1);
    append_faces(mesh, static_cast<Index>(slices.bytes.size()), exec, [&](Index i, PolygonMesh& faces) {
        const auto first_of_slice = static_cast<Index>(n_vertices_before(slices.counts[i]));
        PlyTextSource source(TextScanner(after_header(), slices.bytes[i]));
        read_elements(source, slice_between(slices, i, slices.counts[i + 1].n_lines),
                      {mesh.vertices, first_of_slice, faces, first});
    });
    return mesh;
}

void SlicedPly::check(const TextScanner& scanner, const TextSlices& slices, CheckedSlice& found) const
{
    const std::int64_t own_end = std::min(slices.counts.back().n_lines, n_lines_);
    const std::int64_t end = is_last(slices.bytes.front()) ? n_lines_ : own_end;
    const Index first = first_vertex(slices);
    found.mesh.vertices = uninitialised_points(static_cast<Index>(n_vertices_before({.n_lines = own_end})) - first);
    PlyTextSource source(scanner);
    source.note_faults_in(&found.faults);
    read_elements(source, slice_between(slices, 0, end), {found.mesh.vertices, first, found.mesh, first});
    source.finish();
}

}  // namespace

std::unique_ptr<SlicedText> slice_ply_text(const std::filesystem::path& path, std::string_view text)
{
    TextScanner scanner(path, text, ply_syntax);
    PlyHeader header = read_ply_header(scanner);
    require_surface(scanner, header);
    return std::make_unique<SlicedPly>(path, scanner, std::move(header));
}

}  // namespace seamflow
