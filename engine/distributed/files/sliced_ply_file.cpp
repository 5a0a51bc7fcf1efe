#include "engine/distributed/files/sliced_ply_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/distributed/files/shared_faults.h"
#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/parts/element_ranges.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/formats/off.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_ranges.h"
#include "partition/formats/splicing.h"
#include "partition/io/input_file.h"
#include "partition/io/shared_output.h"

namespace seamflow {

namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// A range of bytes of a file.
struct ByteRange {
    std::size_t begin = 0;
    std::size_t end = 0;

    /// In a file that may be shorter by now.
    [[nodiscard]] std::string_view of(std::string_view content) const
    {
        return content.substr(std::min(begin, content.size()), end - begin);
    }
};

/// A rank's range of n elements.
struct ElementRange {
    Index begin = 0;
    Index end = 0;

    ElementRange(Index n, const Communicator& comm, Index block)
        : begin(static_cast<Index>(begin_of_range(n, comm.rank(), comm.size(), block)))
        , end(static_cast<Index>(begin_of_range(n, comm.rank() + 1, comm.size(), block)))
    {
    }
};

/// @returns nowhere if they are not all there.
std::size_t end_of_faces(const PlyRanges& ply, std::size_t byte, const ElementRange& faces)
{
    try {
        return ply.end_of_faces(byte, faces.begin, faces.end);
    } catch (const InputError&) {
        return nowhere;
    }
}

/// Where the faces of this rank are. If every rank's end where the next rank's begin, all are where they seem to be, as
/// is the case if all are triangles. If not, one rank after another passes over its faces.
/// @returns an end that is nowhere if it is not in the file, and the same for the begin on all later ranks.
ByteRange find_faces(Communicator& comm, const PlyRanges& ply, const ElementRange& faces)
{
    ByteRange own{ply.likely_begin(faces.begin), 0};
    own.end = end_of_faces(ply, own.begin, faces);
    const auto likely = comm.gather_all(std::vector<ByteRange>{own});
    const auto gap = std::ranges::adjacent_find(
        likely, [](const ByteRange& range, const ByteRange& next) { return range.end != next.begin; });
    if (gap == likely.end() && likely.back().end != nowhere)
        return own;
    std::size_t next = ply.likely_begin(0);
    for (int r = 0; r < comm.size(); ++r) {
        std::vector<std::size_t> end;
        if (r == comm.rank()) {
            own = {next, next == nowhere ? nowhere : end_of_faces(ply, next, faces)};
            end.push_back(own.end);
        }
        next = comm.gather_all(end).front();
    }
    return own;
}

class SlicedPlyFile final : public SharedMeshFile {
  public:
    SlicedPlyFile(const std::filesystem::path& path, FileFormat format, const FileSharing& sharing)
        : SharedMeshFile(path)
        , file_(path)
        , format_(format)
        , sharing_(sharing)
    {
    }

    RankSlice read(Communicator& comm) override
    {
        const InputFile input(file_);
        if (format_ == FileFormat::Off)
            find_layout(comm, input.content());
        std::unique_ptr<PlyRanges> opened;
        comm.look_together([&] { opened = ranges_of(input.content()); });
        const PlyRanges& ply = *opened;
        const ElementRange vertices(ply.n_vertices(), comm, sharing_.block);
        const ElementRange faces(ply.n_faces(), comm, sharing_.block);
        RankSlice slice;
        comm.look_together([&] { slice.vertices = ply.vertices(vertices.begin, vertices.end); });
        others_ = find_faces(comm, ply, faces);
        faces_begin_ = others_.begin;
        read_faces(comm, ply, faces, slice, faults_);
        comm.look_together([&] {
            if (ply.n_vertices() == 0)
                throw InputError(fmt::format("{}: byte {}: the file has no vertices; export the mesh again",
                                             file_.path().string(), ply.header_bytes().size()));
            if (comm.rank() == comm.size() - 1)
                ply.require_end(others_.end);
        });
        if (comm.rank() == 0)
            others_.begin = static_cast<std::size_t>(end_of_vertices(ply) - ply.content().data());
        if (comm.rank() == comm.size() - 1)
            others_.end = ply.content().size();
        checksum_ = checksum(ply, vertices);
        return move_to_ranges(comm, std::move(slice), sharing_.block);
    }

    void require_writable_as(const std::filesystem::path& path) const override { require_slices_of(format_, path); }

    std::vector<std::string> write(Communicator& comm, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        const InputFile input(file_);
        const auto opened = unchanged(comm, input.content());
        const PlyRanges& ply = *opened;
        const ElementRange own(ply.n_vertices(), comm, sharing_.block);
        if (format_ == FileFormat::Off)
            check_together(comm, [&] { require_fits_binary_off(path, vertices, own.begin, run_serially); });
        const std::vector<PlyChange> changes =
            changes_of_positions(ply.vertex_element(), fit_all(comm, coordinates_fit(ply.vertex_element(), vertices)));
        std::vector<std::string> remarks;
        bool rounded = false;
        write_together(comm, path, [&](const SharedOutput& output) {
            const RewriteVertices rewrite = [&](ByteWriter& piece, Index begin, Index end) {
                return rewrite_ply_vertices(piece, ply, begin, vertices.middleRows(begin - own.begin, end - begin),
                                            changes);
            };
            std::tie(remarks, rounded) = write_slice(comm, output, ply, own, changes, rewrite);
        });
        const auto all_rounded = comm.gather_all(std::vector<char>{static_cast<char>(rounded ? 1 : 0)});
        if (std::ranges::find(all_rounded, 1) != all_rounded.end())
            remarks.push_back(rounding_remark(file_.path()));
        return remarks;
    }

    FileFields read_fields(Communicator& comm, const std::vector<std::string>& names) override
    {
        if (format_ != FileFormat::Ply)
            return SharedMeshFile::read_fields(comm, names);
        const InputFile input(file_);
        const auto opened = unchanged(comm, input.content());
        const ElementRange own(opened->n_vertices(), comm, sharing_.block);
        FileFields fields;
        comm.look_together([&] { fields = read_ply_fields(*opened, names, own.begin, own.end); });
        return fields;
    }

    std::vector<std::string> write_fields(Communicator& comm, const std::filesystem::path& path,
                                          FileFields& fields) override
    {
        const InputFile input(file_);
        const auto opened = unchanged(comm, input.content());
        const PlyRanges& ply = *opened;
        const ElementRange own(ply.n_vertices(), comm, sharing_.block);
        const FileFields extremes{fields.names, extremes_of_all(comm, fields.values)};
        std::vector<PlyChange> changes;
        std::vector<std::string> remarks;
        check_together(comm, [&] {
            require_writable(path, extremes, static_cast<Index>(extremes.values.rows()), run_serially);
            changes = changes_of_fields(ply.vertex_element(), extremes, path, remarks);
        });
        const RewriteVertices rewrite = [&](ByteWriter& piece, Index begin, Index end) {
            rewrite_ply_fields(piece, ply, begin, fields.values.middleRows(begin - own.begin, end - begin), changes);
            return false;
        };
        write_together(comm, path, [&](const SharedOutput& output) {
            const auto of_header = write_slice(comm, output, ply, own, changes, rewrite).first;
            remarks.insert(remarks.end(), of_header.begin(), of_header.end());
        });
        round_as_written(fields, extremes.values, run_serially);
        return remarks;
    }

    void write_labelled(Communicator& comm, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        const InputFile input(file_);
        const auto opened = unchanged(comm, input.content());
        const PlyRanges& ply = *opened;
        const ElementRange faces(ply.n_faces(), comm, sharing_.block);
        RankSlice slice;
        slice.vertices = vertices;
        FaultLog known_faults;
        read_faces(comm, ply, faces, slice, known_faults);
        const PolygonMesh mesh = mesh_of(move_to_ranges(comm, std::move(slice), sharing_.block));
        write_labelled_together(comm, path, mesh, labels);
    }

  private:
    /// Elements that are made and written at once.
    static constexpr Index at_once = 1 << 14;

    [[nodiscard]] std::unique_ptr<PlyRanges> ranges_of(std::string_view content) const
    {
        if (format_ == FileFormat::Ply)
            return std::make_unique<PlyRanges>(file_.path(), content);
        return std::make_unique<PlyRanges>(file_.path(), content, layout_, elements_begin_);
    }

    std::unique_ptr<PlyRanges> unchanged(Communicator& comm, std::string_view content) const
    {
        std::unique_ptr<PlyRanges> ply;
        comm.look_together([&] {
            try {
                ply = ranges_of(content);
            } catch (const InputError&) {
                throw InputError(changed_since_read(file_.path()));
            }
            if (checksum(*ply, ElementRange(ply->n_vertices(), comm, sharing_.block)) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
        return ply;
    }

    /// Finds the first layout of binary OFF that fits.
    void find_layout(Communicator& comm, std::string_view content)
    {
        const std::size_t offset = start_of_binary_off(content).value_or(0);
        elements_begin_ = offset + binary_off_counts_bytes;
        for (const PlyHeader& header : layouts_of_binary_off(content, offset)) {
            layout_ = header;
            if (fits(comm, content))
                return;
        }
        comm.look_together([&] { refuse_binary_off(file_.path(), content, offset); });
    }

    /// Whether the data end where the counts imply.
    bool fits(Communicator& comm, std::string_view content) const
    {
        std::unique_ptr<PlyRanges> off;
        try {
            off = ranges_of(content);
        } catch (const InputError&) {
            return false;
        }
        std::uint8_t is_there = 1;
        const ByteRange own = find_faces(comm, *off, ElementRange(off->n_faces(), comm, sharing_.block));
        try {
            if (own.end == nowhere)
                is_there = 0;
            else if (comm.rank() == comm.size() - 1)
                off->require_end(own.end);
        } catch (const InputError&) {
            is_there = 0;
        }
        const auto all = comm.gather_all(std::vector<std::uint8_t>{is_there});
        return std::ranges::find(all, 0) == all.end();
    }

    /// @param faces of this rank in the file. @param faults receives what is left out, at rank 0.
    void read_faces(Communicator& comm, const PlyRanges& ply, const ElementRange& faces, RankSlice& slice,
                    FaultLog& faults) const
    {
        FaultLog own{.of_faces_alone = true};
        comm.look_together([&] {
            if (faces_begin_ == nowhere)
                return;
            PolygonMesh mesh = ply.faces(faces_begin_, faces.begin, faces.end, own);
            slice.face_offsets = std::move(mesh.face_offsets);
            slice.corners.assign(mesh.face_vertices.begin(), mesh.face_vertices.end());
        });
        faults = join_faults(comm, own, faces.end - faces.begin);
    }

    static const char* end_of_vertices(const PlyRanges& ply)
    {
        const std::string_view all = ply.bytes_of_vertices(0, ply.n_vertices());
        return all.data() + all.size();
    }

    [[nodiscard]] XXH64_hash_t checksum(const PlyRanges& ply, const ElementRange& vertices) const
    {
        const std::string_view positions = ply.bytes_of_vertices(vertices.begin, vertices.end);
        const std::string_view others = others_.of(ply.content());
        return XXH3_64bits(positions.data(), positions.size()) ^
               XXH3_64bits_withSeed(others.data(), others.size(), ply.content().size());
    }

    /// Writes the vertices from `begin` to `end` - 1 of the file. @returns whether positions were rounded.
    using RewriteVertices = std::function<bool(ByteWriter& piece, Index begin, Index end)>;

    std::pair<std::vector<std::string>, bool> write_slice(Communicator& comm, const SharedOutput& output,
                                                          const PlyRanges& ply, const ElementRange& own,
                                                          const std::vector<PlyChange>& changes,
                                                          const RewriteVertices& rewrite) const
    {
        OutputBuffer header;
        std::vector<std::string> remarks;
        if (format_ == FileFormat::Off)
            header.text(ply.header_bytes());
        else
            remarks = rewrite_ply_header(header, ply.path(), ply.header_bytes(), ply.vertex_element(), changes);
        header.text(ply.bytes_before_vertices());
        if (comm.rank() == 0)
            output.write(header.content(), 0);
        const std::size_t vertex_bytes = bytes_of_vertex(ply, changes);
        bool rounded = false;
        for (Index begin = own.begin; begin < own.end; begin += at_once) {
            const Index end = std::min(own.end, begin + at_once);
            OutputBuffer piece;
            rounded |= rewrite(piece, begin, end);
            output.write(piece.content(), header.content().size() + at(begin) * vertex_bytes);
        }
        const auto old_end = static_cast<std::size_t>(end_of_vertices(ply) - ply.content().data());
        const std::size_t new_end = header.content().size() + at(ply.n_vertices()) * vertex_bytes;
        output.write(others_.of(ply.content()), new_end + (others_.begin - old_end));
        return {std::move(remarks), rounded};
    }

    static std::size_t bytes_of_vertex(const PlyRanges& ply, const std::vector<PlyChange>& changes)
    {
        std::size_t n = 0;
        for (std::size_t p = 0; p < changes.size(); ++p)
            n += size_in_bytes(changes[p].column < 0 ? ply.vertex_element().properties[p].type : changes[p].type);
        return n;
    }

    OpenFile file_;
    FileFormat format_;
    /// Layout of a binary OFF file.
    PlyHeader layout_;
    std::size_t elements_begin_ = 0;
    FileSharing sharing_;
    /// The bytes behind the vertices that this rank copies, and what it has read.
    ByteRange others_;
    std::size_t faces_begin_ = 0;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_ply(const std::filesystem::path& path, FileFormat format,
                                                const FileSharing& sharing)
{
    return std::make_unique<SlicedPlyFile>(path, format, sharing);
}

}  // namespace seamflow
