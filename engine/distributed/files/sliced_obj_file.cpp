#include "engine/distributed/files/sliced_obj_file.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/parts/stretches.h"
#include "partition/errors.h"
#include "partition/formats/obj.h"
#include "partition/formats/splicing.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

/// The bytes of a file that are for one rank.
struct ObjShare {
    TextScanner whole;
    /// From the end of a line to the end of another; perhaps empty.
    std::string_view own;
    /// In pieces for threads, at least one.
    std::vector<std::string_view> pieces;

    ObjShare(const std::filesystem::path& path, std::string_view text, const Conversation& talk)
        : whole(path, text, obj_syntax)
    {
        const std::string_view rest = whole.rest();
        const auto n_ranks = static_cast<std::size_t>(talk.size());
        const std::vector<std::string_view> shares = whole.slices((rest.size() + n_ranks - 1) / n_ranks);
        const auto rank = static_cast<std::size_t>(talk.rank());
        own = rank < shares.size() ? shares[rank] : rest.substr(rest.size());
        pieces = TextScanner(whole, own).slices(Slicing{}.bytes);
        if (pieces.empty())
            pieces.push_back(own);
    }

    /// What precedes the first line.
    [[nodiscard]] std::string_view head(std::string_view text) const
    {
        return text.substr(0, text.size() - whole.rest().size());
    }
};

class SlicedObjFile final : public SharedMeshFile {
  public:
    SlicedObjFile(const std::filesystem::path& path, const FileSharing& sharing, Loop loop)
        : file_(path)
        , sharing_(sharing)
        , loop_(std::move(loop))
    {
    }

    RankSlice read(Conversation& talk) override
    {
        const InputFile input(file_);
        const ObjShare share(file_.path(), input.content(), talk);
        count(talk, share);
        RankSlice slice = read_share(talk, share);
        checksum_ = checksum(share, input.content());
        return slice;
    }

    void require_writable_as(const std::filesystem::path& path) const override
    {
        require_slices_of(FileFormat::Obj, path);
    }

    std::vector<std::string> write(Conversation& talk, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        const InputFile input(file_);
        const ObjShare share = unchanged(talk, input);
        const auto bounds = gather_bounds_of(talk, n_own_vertices());
        const auto stretches = bounds_of_stretches(bounds.back(), talk.size(), sharing_.block);
        std::vector<OutputBuffer> texts =
            rewrite_obj_slices(share.whole, share.pieces, counts_, move_rows(talk, vertices, stretches, bounds), loop_);
        std::size_t bytes = 0;
        for (const OutputBuffer& text : texts)
            bytes += text.content().size();
        const std::string_view head = share.head(input.content());
        auto offset = head.size() +
                      static_cast<std::size_t>(gather_bounds_of(talk, static_cast<std::int64_t>(bytes))[talk.rank()]);
        write_together(talk, path, [&](const SharedOutput& output) {
            if (talk.rank() == 0)
                output.write(head, 0);
            for (const OutputBuffer& text : texts) {
                output.write(text.content(), offset);
                offset += text.content().size();
            }
        });
        return remarks();
    }

    void write_labelled(Conversation& talk, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        const InputFile input(file_);
        PolygonMesh mesh = mesh_of(read_share(talk, unchanged(talk, input)));
        mesh.vertices = vertices;
        write_labelled_together(talk, path, mesh, labels);
    }

  private:
    static constexpr std::int64_t most = std::numeric_limits<Index>::max();

    [[nodiscard]] Index n_own_vertices() const { return counts_.back().n_vertices - counts_.front().n_vertices; }

    [[nodiscard]] XXH64_hash_t checksum(const ObjShare& share, std::string_view text) const
    {
        return XXH3_64bits_withSeed(share.own.data(), share.own.size(), text.size());
    }

    [[nodiscard]] InputError too_many(const char* what) const
    {
        return InputError(
            fmt::format("{}: more than {} {}; divide the mesh into several files", file_.path().string(), most, what));
    }

    /// All ranks have found the same.
    [[noreturn]] static void refuse(Conversation& talk, const InputError& error)
    {
        talk.look_together([&] { throw error; });
        throw error;
    }

    /// Counts the vertices before each piece.
    void count(Conversation& talk, const ObjShare& share)
    {
        talk.look_together([&] {
            try {
                counts_ = count_obj(share.whole, share.pieces, loop_);
            } catch (const InputError&) {
                throw too_many("vertices or normals");
            }
        });
        const auto vertices = gather_bounds_of(talk, counts_.back().n_vertices);
        const auto normals = gather_bounds_of(talk, counts_.back().n_normals);
        if (vertices.back() > most || normals.back() > most)
            refuse(talk, too_many("vertices or normals"));
        for (ObjCounts& counts : counts_) {
            counts.n_vertices += static_cast<Index>(vertices[talk.rank()]);
            counts.n_normals += static_cast<Index>(normals[talk.rank()]);
        }
        n_vertices_ = static_cast<Index>(vertices.back());
        n_normals_ = static_cast<Index>(normals.back());
    }

    RankSlice read_share(Conversation& talk, const ObjShare& share)
    {
        PolygonMesh mesh;
        bool is_faultless = n_vertices_ > 0;
        try {
            mesh = read_obj_slices(share.whole, share.pieces, counts_, n_vertices_, loop_);
        } catch (const InputError&) {
            is_faultless = false;
        }
        const auto all = talk.gather_all(std::vector<char>{static_cast<char>(is_faultless ? 1 : 0)});
        if (std::ranges::find(all, 0) != all.end())
            complain(talk, share);
        if (gather_bounds_of(talk, mesh.n_faces()).back() > most)
            refuse(talk, too_many("faces"));
        RankSlice found;
        found.vertices = std::move(mesh.vertices);
        found.face_offsets = std::move(mesh.face_offsets);
        found.corners.assign(mesh.face_vertices.begin(), mesh.face_vertices.end());
        return move_to_stretches(talk, found, sharing_.block);
    }

    /// Throws on all ranks what a reader of the whole file would complain about first.
    [[noreturn]] void complain(Conversation& talk, const ObjShare& share) const
    {
        TextScanner counter(share.whole, share.own);
        while (counter.next_line()) {
        }
        const auto lines = gather_bounds_of(talk, static_cast<std::int64_t>(counter.line()));
        const TextScanner scanner(share.whole, share.own, static_cast<std::size_t>(lines[talk.rank()]));
        const ObjFaults faults = faults_of_obj_slice(scanner, counts_.front(), counts_.back(), n_vertices_);
        for (const std::string& fault : {faults.of_line, faults.of_reference})
            talk.look_together([&] {
                if (!fault.empty())
                    throw InputError(fault);
            });
        if (n_vertices_ > 0)
            throw std::logic_error("a fault was found once, but not twice");
        refuse(talk, InputError(scanner.position_of(static_cast<std::size_t>(lines.back())) +
                                ": the file has no vertices; export the mesh again"));
    }

    ObjShare unchanged(Conversation& talk, const InputFile& input) const
    {
        ObjShare share(file_.path(), input.content(), talk);
        talk.look_together([&] {
            if (checksum(share, input.content()) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
        return share;
    }

    [[nodiscard]] std::vector<std::string> remarks() const
    {
        if (n_normals_ == 0)
            return {};
        return {fmt::format("the {} (vn) of {} stay as they were: ranks that each have a slice of the file do not make "
                            "them new",
                            counted(at(n_normals_), "normal", "normals"), file_.path().string())};
    }

    OpenFile file_;
    FileSharing sharing_;
    Loop loop_;
    /// What stands before each piece of this rank's share, and behind it.
    std::vector<ObjCounts> counts_;
    /// Of the whole file.
    Index n_vertices_ = 0;
    Index n_normals_ = 0;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_obj(const std::filesystem::path& path, const FileSharing& sharing,
                                                const Loop& loop)
{
    return std::make_unique<SlicedObjFile>(path, sharing, loop);
}

}  // namespace seamflow
