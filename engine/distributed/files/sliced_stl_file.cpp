#include "engine/distributed/files/sliced_stl_file.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/parts/corner_positions.h"
#include "engine/distributed/parts/joined_points.h"
#include "engine/distributed/parts/stretches.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/formats/splicing.h"
#include "partition/formats/stl.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

class SlicedStlFile final : public SharedMeshFile {
  public:
    SlicedStlFile(const std::filesystem::path& path, const FileSharing& sharing)
        : file_(path)
        , sharing_(sharing)
    {
    }

    RankSlice read(Conversation& talk) override
    {
        const InputFile input(file_);
        std::optional<StlStretches> stl;
        talk.look_together([&] { stl.emplace(file_.path(), input.content()); });
        RankSlice slice = read_stretch(talk, *stl);
        checksum_ = checksum(talk, *stl);
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
        write_together(talk, path, [&](const SharedOutput& output) {
            if (talk.rank() == 0) {
                OutputBuffer header;
                write_binary_stl_header(header, static_cast<Index>(bounds.faces.back()));
                output.write(header.content(), 0);
            }
            std::size_t offset =
                binary_stl_header_bytes + static_cast<std::size_t>(bounds.faces[talk.rank()]) * binary_stl_facet_bytes;
            constexpr Index at_once = 1 << 14;
            for (Index begin = 0; begin < slice.n_faces(); begin += at_once) {
                OutputBuffer piece;
                for (Index f = begin; f < std::min(slice.n_faces(), begin + at_once); ++f)
                    write_binary_stl_facet(piece, facet(slice, positions, f));
                output.write(piece.content(), offset);
                offset += piece.content().size();
            }
        });
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

    /// The first and the one behind the last facet of this rank.
    [[nodiscard]] std::pair<Index, Index> own_facets(const Conversation& talk, const StlStretches& stl) const
    {
        const auto bound = [&](int r) {
            return static_cast<Index>(begin_of_stretch(stl.n_facets(), r, talk.size(), sharing_.block));
        };
        return {bound(talk.rank()), bound(talk.rank() + 1)};
    }

    [[nodiscard]] XXH64_hash_t checksum(const Conversation& talk, const StlStretches& stl) const
    {
        const auto own = own_facets(talk, stl);
        const std::string_view bytes = stl.bytes(own.first, own.second);
        return XXH3_64bits_withSeed(bytes.data(), bytes.size(), at(stl.n_facets()));
    }

    RankSlice read_stretch(Conversation& talk, const StlStretches& stl) const
    {
        const auto own = own_facets(talk, stl);
        PolygonMesh faces;
        PointNumbers points;
        talk.look_together([&] { points = stl.facets(own.first, own.second, faces); });
        talk.look_together([&] { stl.require_end(); });
        const JoinedPoints joined = join_points(talk, points.points());
        points = {};
        const auto bounds = gather_bounds_of(talk, joined.firsts.rows());
        talk.look_together([&] {
            if (bounds.back() > std::numeric_limits<Index>::max())
                throw InputError(fmt::format("{}: more than 2147483647 vertices; divide the mesh into several files",
                                             file_.path().string()));
        });
        RankSlice slice;
        slice.vertices =
            move_rows(talk, joined.firsts, bounds, bounds_of_stretches(bounds.back(), talk.size(), sharing_.block));
        slice.face_offsets = std::move(faces.face_offsets);
        for (const Index corner : faces.face_vertices)
            slice.corners.push_back(joined.numbers[corner]);
        return slice;
    }

    /// The same as was read, but for the positions.
    RankSlice read_again(Conversation& talk, const Points& vertices) const
    {
        const InputFile input(file_);
        RankSlice slice;
        std::optional<StlStretches> stl;
        talk.look_together([&] {
            stl.emplace(file_.path(), input.content());
            if (checksum(talk, *stl) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
        slice = read_stretch(talk, *stl);
        slice.vertices = vertices;
        return slice;
    }

    /// Throws on all ranks what write_mesh would say first.
    static void require_fits(Conversation& talk, const std::filesystem::path& path, const RankSlice& slice,
                             const SliceBounds& bounds, const CornerPositions& positions)
    {
        const auto refuse_together = [&](const std::function<void()>& check) {
            std::string fault;
            try {
                check();
            } catch (const OutputError& error) {
                fault = error.what() + std::string("\n");
            }
            const auto faults = talk.gather_all(std::vector<char>(fault.begin(), fault.end()));
            talk.at_first_rank([&] {
                if (!faults.empty())
                    throw OutputError(std::string(faults.begin(), std::ranges::find(faults, '\n')));
            });
        };
        refuse_together(
            [&] { require_floats(path, slice.vertices, static_cast<Index>(bounds.vertices[talk.rank()])); });
        refuse_together([&] {
            for (Index f = 0; f < slice.n_faces(); ++f) {
                std::array<Index, 3> corners{};
                std::transform(slice.corners.begin() + slice.face_offsets[f],
                               slice.corners.begin() + slice.face_offsets[f + 1], corners.begin(),
                               [](std::int64_t corner) { return static_cast<Index>(corner); });
                require_distinct_floats(path, static_cast<Index>(bounds.faces[talk.rank()]) + f, corners,
                                        facet(slice, positions, f));
            }
        });
    }

    OpenFile file_;
    FileSharing sharing_;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_stl(const std::filesystem::path& path, const FileSharing& sharing)
{
    return std::make_unique<SlicedStlFile>(path, sharing);
}

}  // namespace seamflow
