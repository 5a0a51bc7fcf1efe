#include "engine/distributed/files/open_together.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/files/shared_writing.h"
#include "engine/distributed/files/sliced_ply_file.h"
#include "engine/distributed/files/sliced_stl_file.h"
#include "engine/distributed/files/sliced_text_file.h"
#include "engine/distributed/parts/element_ranges.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/formats/off.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/stl.h"
#include "partition/formats/text_slices.h"
#include "partition/io/gzip.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

/// A file that rank 0 reads and writes alone.
class WholeMeshFile final : public SharedMeshFile {
  public:
    WholeMeshFile(std::filesystem::path path, const FileSharing& sharing, Executor exec)
        : SharedMeshFile(path)
        , path_(std::move(path))
        , sharing_(sharing)
        , exec_(std::move(exec))
    {
    }

    RankSlice read(Communicator& comm) override
    {
        comm.at_first_rank([&] { file_ = read_faulty_mesh(path_, faults_, exec_); });
        is_read_ = comm.rank() == 0;
        return hand_out(comm, file_.mesh, sharing_.block);
    }

    void require_writable_as(const std::filesystem::path& path) const override
    {
        if (is_read_)
            static_cast<void>(kind_for_writing(path, file_.kind));
    }

    std::vector<std::string> write(Communicator& comm, const std::filesystem::path& path,
                                   const Points& vertices) override
    {
        take_positions(comm, vertices);
        std::vector<std::string> remarks;
        comm.at_first_rank([&] {
            const FileKind kind = kind_for_writing(path, file_.kind);
            if (kind.format == file_.kind.format)
                remarks = write_mesh_like(*file_.source, path, file_.mesh, exec_, seam_distance_);
            else
                remarks = write_mesh(path, file_.mesh, kind, exec_);
        });
        return remarks;
    }

    FileFields read_fields(Communicator& comm, const std::vector<std::string>& names) override
    {
        FileFields all;
        comm.at_first_rank([&] { all = seamflow::read_fields(*file_.source, names, exec_); });
        FileFields own;
        own.names = names_of_first(comm, all);
        own.whole = comm.broadcast(all.whole);
        own.decimals = comm.broadcast(all.decimals);
        const std::int64_t n = comm.broadcast(std::vector<std::int64_t>{file_.mesh.n_vertices()}).front();
        const std::vector<std::int64_t> bounds = bounds_of_ranges(n, comm.size(), sharing_.block);
        own.values.resize(bounds[comm.rank() + 1] - bounds[comm.rank()], std::ssize(own.names));
        for (Eigen::Index c = 0; c < own.values.cols(); ++c) {
            std::vector<double> column;
            if (comm.rank() == 0)
                column.assign(all.values.col(c).begin(), all.values.col(c).end());
            std::ranges::copy(hand_out(comm, column, bounds), own.values.col(c).begin());
        }
        return own;
    }

    std::vector<std::string> write_fields(Communicator& comm, const std::filesystem::path& path,
                                          FileFields& fields) override
    {
        FileFields all{.names = fields.names};
        all.values.resize(file_.mesh.n_vertices(), std::ssize(fields.names));
        for (Eigen::Index c = 0; c < fields.values.cols(); ++c) {
            const auto own = fields.values.col(c);
            std::ranges::copy(comm.gather_at_first(std::vector<double>(own.begin(), own.end())),
                              all.values.col(c).begin());
        }
        std::vector<std::string> remarks;
        std::vector<char> is_alike(1);
        comm.at_first_rank([&] {
            const FileKind kind = kind_for_writing(path, file_.kind);
            is_alike[0] = kind.format == file_.kind.format ? 1 : 0;
            remarks = is_alike[0] != 0 ? write_mesh_like(*file_.source, path, file_.mesh, all, exec_)
                                       : write_mesh(path, file_.mesh, kind, all, exec_);
        });
        if (comm.broadcast(is_alike)[0] != 0)
            round_as_written(fields, extremes_of_all(comm, fields.values), exec_);
        return remarks;
    }

    void write_labelled(Communicator& comm, const std::filesystem::path& path, const Points& vertices,
                        const std::vector<Index>& labels) override
    {
        take_positions(comm, vertices);
        const std::vector<Index> all = comm.gather_at_first(labels);
        comm.at_first_rank([&] { write_labelled_ply(path, file_.mesh, all, exec_); });
    }

    [[nodiscard]] const MeshFile* whole() const override { return is_read_ ? &file_ : nullptr; }

  private:
    static std::vector<std::string> names_of_first(Communicator& comm, const FileFields& fields)
    {
        std::string joined;
        for (const std::string& name : fields.names)
            joined += name + '\n';
        const std::vector<char> of_first = comm.broadcast(std::vector<char>(joined.begin(), joined.end()));
        std::istringstream lines(std::string(of_first.begin(), of_first.end()));
        std::vector<std::string> names;
        for (std::string name; std::getline(lines, name);)
            names.push_back(name);
        return names;
    }

    void take_positions(Communicator& comm, const Points& vertices)
    {
        Points all = gather_positions(comm, vertices);
        if (comm.rank() == 0)
            file_.mesh.vertices = std::move(all);
    }

    std::filesystem::path path_;
    FileSharing sharing_;
    Executor exec_;
    /// At rank 0.
    MeshFile file_;
    bool is_read_ = false;
};

/// 0 if it is not a file: whoever reads it reports that.
std::uint64_t bytes_in(const std::filesystem::path& path)
{
    std::error_code error;
    const std::uintmax_t size = is_input_stream(path) ? 0 : std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

/// Regardless of its name.
bool is_packed(const std::filesystem::path& path)
{
    std::array<char, 2> bytes{};
    std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
    return is_gzip_name(path) || is_gzip({bytes.data(), bytes.size()});
}

/// Whether a file is text.
/// @throws InputError as a reader of the whole file does.
bool is_text(const std::filesystem::path& path, FileFormat format)
{
    const OpenFile file(path);
    const InputFile input(file);
    if (format == FileFormat::Off)
        return !start_of_binary_off(input.content());
    if (format == FileFormat::Stl)
        return is_text_stl(input.content());
    if (format != FileFormat::Ply)
        return true;
    TextScanner scanner(path, input.content(), ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    if (const PlyElement* const strips = header.element("tristrips"); strips != nullptr && strips->count > 0)
        throw InputError(fmt::format("{}: ranks cannot share triangle strips; smooth the mesh in a single process, or "
                                     "export it with faces instead of strips",
                                     scanner.position_of(strips->line)));
    return header.encoding == Encoding::Ascii;
}

std::unique_ptr<SharedMeshFile> open_sliced(const std::filesystem::path& path, FileFormat format, bool is_text,
                                            const FileSharing& sharing, const Executor& exec)
{
    if (format == FileFormat::Stl)
        return open_sliced_stl(path, is_text ? Encoding::Ascii : Encoding::BinaryLittleEndian, sharing, exec);
    if (!is_text)
        return open_sliced_ply(path, format, sharing);
    const TextSlicer slicer = format == FileFormat::Obj   ? slice_obj_text
                              : format == FileFormat::Off ? slice_off_text
                              : format == FileFormat::Ply ? slice_ply_text
                                                          : nullptr;
    if (slicer == nullptr)
        throw InputError(fmt::format("{}: ranks cannot read slices of {} files; let one rank read all (--whole-up-to), "
                                     "or convert the file",
                                     path.string(), traits_of(format).name));
    return open_sliced_text(path, slicer, sharing, exec);
}

}  // namespace

std::unique_ptr<SharedMeshFile> open_together(Communicator& comm, const std::filesystem::path& path,
                                              const FileSharing& sharing, const Executor& exec)
{
    std::uint64_t size = 0;
    comm.at_first_rank([&] { size = bytes_in(path); });
    size = comm.broadcast(std::vector<std::uint64_t>{size}).front();
    const auto format = format_of(path);
    if (size <= sharing.whole_up_to || !format)
        return std::make_unique<WholeMeshFile>(path, sharing, exec);
    bool text = false;
    comm.at_first_rank([&] {
        if (is_packed(path))
            throw InputError(fmt::format("{}: the file has {} bytes, more than the {} that one rank reads for all; "
                                         "unpack it, so that every rank can read a slice",
                                         path.string(), size, sharing.whole_up_to));
        text = is_text(path, *format);
    });
    text = comm.broadcast(std::vector<char>{static_cast<char>(text ? 1 : 0)}).front() != 0;
    return open_sliced(path, *format, text, sharing, exec);
}

}  // namespace seamflow
