#include "engine/distributed/files/sliced_text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/distributed/files/shared_faults.h"
#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/parts/element_ranges.h"
#include "partition/errors.h"
#include "partition/formats/splicing.h"
#include "partition/io/input_file.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

/// The bytes of a file that are for one rank.
struct TextShare {
    std::unique_ptr<SlicedText> file;
    std::string_view header;
    /// From the end of a line to the end of another; may be empty.
    std::string_view own;
    /// In pieces for threads, at least one.
    std::vector<std::string_view> pieces;

    TextShare(std::unique_ptr<SlicedText> sliced, std::string_view text, const Communicator& comm)
        : file(std::move(sliced))
    {
        const TextScanner& scanner = file->after_header();
        const std::string_view rest = scanner.rest();
        const auto n_ranks = static_cast<std::size_t>(comm.size());
        const std::vector<std::string_view> shares = scanner.slices((rest.size() + n_ranks - 1) / n_ranks);
        const auto rank = static_cast<std::size_t>(comm.rank());
        header = text.substr(0, text.size() - rest.size());
        own = rank < shares.size() ? shares[rank] : rest.substr(rest.size());
        pieces = TextScanner(scanner, own).slices(Slicing{}.bytes);
        if (pieces.empty())
            pieces.push_back(own);
    }
};

/// The place of a part within a file.
struct BytePlace {
    std::size_t begin = 0;
    std::size_t n = 0;

    BytePlace() = default;
    BytePlace(std::string_view part, std::string_view text)
        : begin(static_cast<std::size_t>(part.data() - text.data()))
        , n(part.size())
    {
    }

    /// In a file that may be shorter by now.
    [[nodiscard]] std::string_view of(std::string_view text) const
    {
        return text.substr(std::min(begin, text.size()), n);
    }
};

class SlicedTextFile final : public SharedMeshFile {
  public:
    SlicedTextFile(const std::filesystem::path& path, TextSlicer slicer, const FileSharing& sharing, Executor exec)
        : SharedMeshFile(path)
        , file_(path)
        , slicer_(slicer)
        , sharing_(sharing)
        , exec_(std::move(exec))
    {
    }

    RankSlice read(Communicator& comm) override
    {
        const InputFile input(file_);
        const TextShare share = share_of(comm, input);
        count(comm, share);
        RankSlice slice = read_share(comm, share, faults_);
        header_ = BytePlace(share.header, input.content());
        own_ = BytePlace(share.own, input.content());
        checksum_ = checksum(input.content());
        return slice;
    }

    void require_writable_as(const std::filesystem::path& path) const override
    {
        require_slices_of(*format_of(file_.path()), path);
    }

    std::vector<std::string> write(Communicator& comm, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        const InputFile input(file_);
        const TextShare share = unchanged(comm, input);
        const auto before = [&](const TextCounts& counts) { return share.file->n_vertices_before(counts); };
        const auto from = gather_bounds_of(comm, before(counts_.back()) - before(counts_.front()));
        const auto ranges = bounds_of_ranges(from.back(), comm.size(), sharing_.block);
        OutputBuffer header;
        const auto remarks = share.file->rewrite_header(header, share.header,
                                                        fit_all(comm, share.file->coordinates_fit(vertices)), all_);
        const Points positions = move_rows(comm, vertices, ranges, from);
        const TextSlices slices{share.pieces, counts_, all_};
        const auto make = [&](Index i, ByteWriter& file) { share.file->rewrite(file, slices, i, positions); };
        const FilePieces pieces = measure_pieces(static_cast<Index>(share.pieces.size()), make, exec_);
        write_pieces_together(comm, path, header.content(), pieces, {}, exec_);
        return remarks;
    }

    void write_labelled(Communicator& comm, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        const InputFile input(file_);
        FaultLog known_faults;
        PolygonMesh mesh = mesh_of(read_share(comm, unchanged(comm, input), known_faults));
        mesh.vertices = vertices;
        write_labelled_together(comm, path, mesh, labels);
    }

  private:
    static constexpr std::int64_t most = std::numeric_limits<Index>::max();

    [[nodiscard]] TextShare share_of(Communicator& comm, const InputFile& input) const
    {
        std::unique_ptr<SlicedText> sliced;
        comm.look_together([&] { sliced = slicer_(file_.path(), input.content()); });
        return TextShare(std::move(sliced), input.content(), comm);
    }

    [[nodiscard]] XXH64_hash_t checksum(std::string_view text) const
    {
        const std::string_view header = header_.of(text);
        const std::string_view own = own_.of(text);
        return XXH3_64bits_withSeed(own.data(), own.size(),
                                    XXH3_64bits_withSeed(header.data(), header.size(), text.size()));
    }

    [[nodiscard]] InputError too_many(const char* what) const
    {
        return InputError(
            fmt::format("{}: more than {} {}; divide the mesh into several files", file_.path().string(), most, what));
    }

    /// All ranks have found the same error.
    [[noreturn]] static void refuse(Communicator& comm, const InputError& error)
    {
        comm.look_together([&] { throw error; });
        throw error;
    }

    /// Counts what precedes each piece.
    void count(Communicator& comm, const TextShare& share)
    {
        comm.look_together([&] {
            try {
                counts_ = share.file->count(share.pieces, exec_);
            } catch (const InputError&) {
                throw too_many("vertices or normals");
            }
        });
        const auto of_ranks = comm.gather_all(std::vector<TextCounts>{counts_.back()});
        TextCounts before;
        all_ = {};
        for (int r = 0; r < comm.size(); ++r) {
            if (r == comm.rank())
                before = all_;
            all_ += of_ranks[static_cast<std::size_t>(r)];
        }
        if (share.file->n_vertices(all_) > most || all_.n_normals > most)
            refuse(comm, too_many("vertices or normals"));
        for (TextCounts& counts : counts_)
            counts += before;
    }

    /// @param faults receives what is left out, at rank 0.
    RankSlice read_share(Communicator& comm, const TextShare& share, FaultLog& faults) const
    {
        CheckedSlice slice;
        std::uint8_t is_faultless = 1;
        try {
            slice.mesh = share.file->read({share.pieces, counts_, all_}, exec_);
        } catch (const InputError&) {
            is_faultless = 0;
        }
        const auto all = comm.gather_all(std::vector<std::uint8_t>{is_faultless});
        if (std::ranges::find(all, 0) != all.end())
            slice = check(comm, share);
        if (gather_bounds_of(comm, slice.mesh.n_faces()).back() > most)
            refuse(comm, too_many("faces"));
        faults = join_faults(comm, slice.faults,
                             slice.mesh.n_faces() + static_cast<Index>(slice.faults.faces_left_out.size()));
        RankSlice found;
        found.vertices = std::move(slice.mesh.vertices);
        found.face_offsets = std::move(slice.mesh.face_offsets);
        found.corners.assign(slice.mesh.face_vertices.begin(), slice.mesh.face_vertices.end());
        slice = {};
        return move_to_ranges(comm, std::move(found), sharing_.block);
    }

    /// Reads the share in one go, and notes what is left out. Throws on all ranks the error that a reader of the whole
    /// file would report first.
    CheckedSlice check(Communicator& comm, const TextShare& share) const
    {
        const TextScanner& whole = share.file->after_header();
        TextScanner counter(whole, share.own);
        while (counter.next_line()) {
        }
        const auto lines = gather_bounds_of(comm, static_cast<std::int64_t>(counter.line()));
        const TextScanner scanner(whole, share.own, whole.line() + static_cast<std::size_t>(lines[comm.rank()]));
        const std::array<TextCounts, 2> counts{counts_.front(), counts_.back()};
        CheckedSlice slice;
        comm.look_together([&] { share.file->check(scanner, {std::array{share.own}, counts, all_}, slice); });
        comm.look_together([&] {
            if (!slice.of_reference.empty())
                throw InputError(slice.of_reference);
        });
        if (share.file->n_vertices(all_) == 0)
            refuse(comm, InputError(scanner.position_of(whole.line() + static_cast<std::size_t>(lines.back())) +
                                    ": the file has no vertices; export the mesh again"));
        return slice;
    }

    TextShare unchanged(Communicator& comm, const InputFile& input) const
    {
        comm.look_together([&] {
            if (checksum(input.content()) != checksum_)
                throw InputError(changed_since_read(file_.path()));
        });
        return share_of(comm, input);
    }

    OpenFile file_;
    TextSlicer slicer_;
    FileSharing sharing_;
    Executor exec_;
    /// Counts before each piece of this rank's share, and behind it; and those of the whole file.
    std::vector<TextCounts> counts_;
    TextCounts all_;
    /// The bytes that were read.
    BytePlace header_;
    BytePlace own_;
    XXH64_hash_t checksum_ = 0;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_sliced_text(const std::filesystem::path& path, TextSlicer slicer,
                                                 const FileSharing& sharing, const Executor& exec)
{
    return std::make_unique<SlicedTextFile>(path, slicer, sharing, exec);
}

}  // namespace seamflow
