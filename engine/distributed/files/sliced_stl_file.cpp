#include "engine/distributed/files/sliced_stl_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
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
        RankSlice slice = move_to_stretches(talk, read_share(talk, *share, faults_), sharing_.block);
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
        const InputFile input(file_);
        require_unchanged(talk, input.content());
        FaultLog known_faults;
        const auto share = share_stl(talk, file_.path(), input.content(), encoding_, loop_);
        RankSlice slice = read_share(talk, *share, known_faults);
        slice.vertices = vertices;
        const SliceBounds bounds = gather_bounds(talk, slice);
        if (encoding_ != Encoding::Ascii)
            check_together(talk,
                           [&] { require_floats(path, vertices, static_cast<Index>(bounds.vertices[talk.rank()])); });
        const CornerPositions positions(talk, slice, bounds);
        const StlForm form(file_.path(), input.content());
        constexpr std::size_t piece_bytes = std::size_t{1} << 18;
        const std::vector<std::string_view> pieces = form.pieces(share->bytes(), piece_bytes);
        const auto n = static_cast<Index>(pieces.size());
        std::vector<Index> first(pieces.size() + 1, 0);
        for_each(loop_, n, [&](Index i) { first[i + 1] = form.count(pieces[i]); });
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::int64_t> n_lines(pieces.size(), 0);
        const auto make = [&](Index i, ByteWriter& file) {
            n_lines[i] = form.rewrite(file, pieces[i], [&](Index f) { return facet(slice, positions, first[i] + f); });
        };
        write_pieces_together(talk, path, form.begin(), measure_pieces(n, make, loop_), form.end(), loop_);
        const auto of_all = talk.gather_all(n_lines);
        return remarks_on_lines(file_.path(), std::accumulate(of_all.begin(), of_all.end(), std::int64_t{0}));
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

    /// With the faces of this rank's share.
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
        return found;
    }

    void require_unchanged(Conversation& talk, std::string_view content) const
    {
        talk.look_together([&] {
            if (checksum(content) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
    }

    /// The same as was read, but for the positions.
    RankSlice read_again(Conversation& talk, const Points& vertices) const
    {
        const InputFile input(file_);
        require_unchanged(talk, input.content());
        FaultLog known_faults;
        const auto share = share_stl(talk, file_.path(), input.content(), encoding_, loop_);
        RankSlice slice = move_to_stretches(talk, read_share(talk, *share, known_faults), sharing_.block);
        slice.vertices = vertices;
        return slice;
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
