#include "engine/distributed/files/sliced_stl_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/distributed/files/shared_faults.h"
#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/files/stl_share.h"
#include "engine/distributed/parts/corner_positions.h"
#include "engine/distributed/parts/joined_points.h"
#include "engine/distributed/parts/stretches.h"
#include "partition/errors.h"
#include "partition/formats/splicing.h"
#include "partition/formats/stl.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

class SlicedStlFile final : public SharedMeshFile {
  public:
    SlicedStlFile(const std::filesystem::path& path, Encoding encoding, const FileSharing& sharing, Loop loop)
        : file_(path)
        , encoding_(encoding)
        , sharing_(sharing)
        , loop_(std::move(loop))
    {
    }

    RankSlice read(Conversation& talk) override
    {
        const InputFile input(file_);
        const auto share = share_stl(talk, file_.path(), input.content(), encoding_, loop_);
        RankSlice slice = read_share(talk, *share, faults_);
        own_begin_ = static_cast<std::size_t>(share->bytes().data() - input.content().data());
        n_own_ = share->bytes().size();
        checksum_ = checksum(input.content());
        return slice;
    }

    void require_writable_as(const std::filesystem::path& path) const override
    {
        require_slices_of(FileFormat::Stl, path);
    }

    std::vector<std::string> write(Conversation& talk, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        const RankSlice slice = read_again(talk, vertices);
        const SliceBounds bounds = gather_bounds(talk, slice);
        const CornerPositions positions(talk, slice, bounds);
        require_fits(talk, path, slice, bounds, positions);
        constexpr Index at_once = 1 << 12;
        const auto make = [&](Index piece, ByteWriter& file) {
            const Index begin = piece * at_once;
            for (Index f = begin; f < begin + std::min(at_once, slice.n_faces() - begin); ++f)
                write_stl_facet(file, facet(slice, positions, f), encoding_);
        };
        const FilePieces pieces = measure_pieces((slice.n_faces() + at_once - 1) / at_once, make, loop_);
        OutputBuffer begin;
        OutputBuffer end;
        write_stl_begin(begin, static_cast<Index>(bounds.faces.back()), encoding_);
        write_stl_end(end, encoding_);
        write_pieces_together(talk, path, begin.content(), pieces, end.content(), loop_);
        return {};
    }

    void write_labelled(Conversation& talk, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        write_labelled_together(talk, path, mesh_of(read_again(talk, vertices)), labels);
    }

  private:
    static StlFacet facet(const RankSlice& slice, const CornerPositions& positions, Index f)
    {
        const std::int64_t* const corners = slice.corners.data() + slice.face_offsets[f];
        return {positions[corners[0]], positions[corners[1]], positions[corners[2]]};
    }

    /// Of what this rank has read.
    /// @param content of a file that may be shorter by now.
    [[nodiscard]] XXH64_hash_t checksum(std::string_view content) const
    {
        const std::string_view own = content.substr(std::min(own_begin_, content.size()), n_own_);
        return XXH3_64bits_withSeed(own.data(), own.size(), content.size());
    }

    /// @param faults receives what is left out, at rank 0.
    RankSlice read_share(Conversation& talk, const StlShare& share, FaultLog& faults) const
    {
        PolygonMesh faces;
        FaultLog own{.of_faces_alone = true};
        PointNumbers points = share.read(talk, faces, own);
        faults = join_faults(talk, own, faces.n_faces() + static_cast<Index>(own.faces_left_out.size()));
        const JoinedPoints joined = join_points(talk, points.points());
        points = {};
        const auto bounds = gather_bounds_of(talk, joined.firsts.rows());
        if (bounds.back() == 0)
            share.refuse_empty(talk);
        talk.look_together([&] {
            if (bounds.back() > std::numeric_limits<Index>::max())
                throw InputError(fmt::format("{}: more than 2147483647 vertices; divide the mesh into several files",
                                             file_.path().string()));
        });
        RankSlice found;
        found.vertices = joined.firsts;
        found.face_offsets = std::move(faces.face_offsets);
        for (const Index corner : faces.face_vertices)
            found.corners.push_back(joined.numbers[corner]);
        return move_to_stretches(talk, std::move(found), sharing_.block);
    }

    /// The same as was read, but for the positions.
    RankSlice read_again(Conversation& talk, const Points& vertices) const
    {
        const InputFile input(file_);
        talk.look_together([&] {
            if (checksum(input.content()) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
        FaultLog known_faults;
        RankSlice slice =
            read_share(talk, *share_stl(talk, file_.path(), input.content(), encoding_, loop_), known_faults);
        slice.vertices = vertices;
        return slice;
    }

    /// Throws on all ranks what write_mesh would say first.
    void require_fits(Conversation& talk, const std::filesystem::path& path, const RankSlice& slice,
                      const SliceBounds& bounds, const CornerPositions& positions) const
    {
        if (encoding_ != Encoding::Ascii)
            check_together(
                talk, [&] { require_floats(path, slice.vertices, static_cast<Index>(bounds.vertices[talk.rank()])); });
        check_together(talk, [&] {
            for (Index f = 0; f < slice.n_faces(); ++f) {
                std::array<Index, 3> corners{};
                std::transform(slice.corners.begin() + slice.face_offsets[f],
                               slice.corners.begin() + slice.face_offsets[f + 1], corners.begin(),
                               [](std::int64_t corner) { return static_cast<Index>(corner); });
                require_distinct_corners(path, static_cast<Index>(bounds.faces[talk.rank()]) + f, corners,
                                         facet(slice, positions, f), encoding_);
            }
        });
    }

    OpenFile file_;
    Encoding encoding_;
    FileSharing sharing_;
    Loop loop_;
    /// What this rank has read of it.
    std::size_t own_begin_ = 0;
    std::size_t n_own_ = 0;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_stl(const std::filesystem::path& path, Encoding encoding,
                                                const FileSharing& sharing, const Loop& loop)
{
    return std::make_unique<SlicedStlFile>(path, encoding, sharing, loop);
}

}  // namespace seamflow
