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
#include "engine/distributed/parts/element_ranges.h"
#include "engine/distributed/parts/joined_points.h"
#include "partition/errors.h"
#include "partition/formats/splicing.h"
#include "partition/formats/stl.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

class SlicedStlFile final : public SharedMeshFile {
  public:
    SlicedStlFile(const std::filesystem::path& path, Encoding encoding, const FileSharing& sharing, Executor exec)
        : SharedMeshFile(path)
        , file_(path)
        , encoding_(encoding)
        , sharing_(sharing)
        , exec_(std::move(exec))
    {
    }

    RankSlice read(Communicator& comm) override
    {
        const InputFile input(file_);
        const auto share = share_stl(comm, file_.path(), input.content(), encoding_, exec_);
        RankSlice slice = move_to_ranges(comm, read_share(comm, *share, faults_), sharing_.block);
        own_begin_ = static_cast<std::size_t>(share->bytes().data() - input.content().data());
        n_own_ = share->bytes().size();
        checksum_ = checksum(input.content());
        return slice;
    }

    void require_writable_as(const std::filesystem::path& path) const override
    {
        require_slices_of(FileFormat::Stl, path);
    }

    std::vector<std::string> write(Communicator& comm, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        const InputFile input(file_);
        require_unchanged(comm, input.content());
        FaultLog known_faults;
        const auto share = share_stl(comm, file_.path(), input.content(), encoding_, exec_);
        RankSlice slice = read_share(comm, *share, known_faults);
        slice.vertices = vertices;
        const SliceBounds bounds = gather_bounds(comm, slice);
        if (encoding_ != Encoding::Ascii)
            check_together(comm,
                           [&] { require_floats(path, vertices, static_cast<Index>(bounds.vertices[comm.rank()])); });
        const CornerPositions positions(comm, slice, bounds);
        const StlForm form(file_.path(), input.content());
        constexpr std::size_t piece_bytes = std::size_t{1} << 18;
        const std::vector<std::string_view> pieces = form.pieces(share->bytes(), piece_bytes);
        const auto n = static_cast<Index>(pieces.size());
        std::vector<Index> first(pieces.size() + 1, 0);
        for_each(exec_, n, [&](Index i) { first[i + 1] = form.count(pieces[i]); });
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::int64_t> n_lines(pieces.size(), 0);
        const auto make = [&](Index i, ByteWriter& file) {
            n_lines[i] = form.rewrite(file, pieces[i], [&](Index f) { return facet(slice, positions, first[i] + f); });
        };
        write_pieces_together(comm, path, form.begin(), measure_pieces(n, make, exec_), form.end(), exec_);
        const auto of_all = comm.gather_all(n_lines);
        return remarks_on_lines(file_.path(), std::accumulate(of_all.begin(), of_all.end(), std::int64_t{0}));
    }

    void write_labelled(Communicator& comm, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        write_labelled_together(comm, path, mesh_of(read_again(comm, vertices)), labels);
    }

  private:
    static StlFacet facet(const RankSlice& slice, const CornerPositions& positions, Index f)
    {
        const std::int64_t* const corners = slice.corners.data() + slice.face_offsets[f];
        return {positions[corners[0]], positions[corners[1]], positions[corners[2]]};
    }

    /// Checksum of what this rank has read.
    /// @param content of a file that may be shorter by now.
    [[nodiscard]] XXH64_hash_t checksum(std::string_view content) const
    {
        const std::string_view own = content.substr(std::min(own_begin_, content.size()), n_own_);
        return XXH3_64bits_withSeed(own.data(), own.size(), content.size());
    }

    /// A slice with the faces of this rank's share.
    /// @param faults receives what is left out, at rank 0.
    RankSlice read_share(Communicator& comm, const StlShare& share, FaultLog& faults) const
    {
        PolygonMesh faces;
        FaultLog own{.of_faces_alone = true};
        Points points = share.read(comm, faces, own);
        faults = join_faults(comm, own, faces.n_faces() + static_cast<Index>(own.faces_left_out.size()));
        const JoinedPoints joined = join_points(comm, points);
        points = Points(0, 3);
        const auto bounds = gather_bounds_of(comm, joined.firsts.rows());
        if (bounds.back() == 0)
            share.refuse_empty(comm);
        comm.look_together([&] {
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

    void require_unchanged(Communicator& comm, std::string_view content) const
    {
        comm.look_together([&] {
            if (checksum(content) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
    }

    /// The slice as it was read, except for the positions.
    RankSlice read_again(Communicator& comm, const Points& vertices) const
    {
        const InputFile input(file_);
        require_unchanged(comm, input.content());
        FaultLog known_faults;
        const auto share = share_stl(comm, file_.path(), input.content(), encoding_, exec_);
        RankSlice slice = move_to_ranges(comm, read_share(comm, *share, known_faults), sharing_.block);
        slice.vertices = vertices;
        return slice;
    }

    OpenFile file_;
    Encoding encoding_;
    FileSharing sharing_;
    Executor exec_;
    /// The bytes that this rank has read.
    std::size_t own_begin_ = 0;
    std::size_t n_own_ = 0;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_stl(const std::filesystem::path& path, Encoding encoding,
                                                const FileSharing& sharing, const Executor& exec)
{
    return std::make_unique<SlicedStlFile>(path, encoding, sharing, exec);
}

}  // namespace seamflow
