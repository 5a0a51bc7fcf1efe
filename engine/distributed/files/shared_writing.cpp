#include "engine/distributed/files/shared_writing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/parts/element_ranges.h"
#include "partition/errors.h"
#include "partition/formats/ply_ranges.h"
#include "partition/io/gzip.h"
#include "partition/io/input_file.h"

namespace seamflow {

namespace {

/// @param first_vertex, first_face_byte where what this rank writes begins, the latter behind the vertices.
void write_labelled_range(const SharedOutput& output, const PolygonMesh& mesh, const std::vector<Index>& labels,
                          const PlyCounts& counts, std::size_t first_vertex, std::size_t first_face_byte)
{
    constexpr Index at_once = 1 << 14;
    constexpr std::size_t bytes_of_vertex = 3 * sizeof(double);
    const std::string header = labelled_ply_header(counts);
    if (first_vertex == 0)
        output.write(header, 0);
    for (Index begin = 0; begin < mesh.n_vertices(); begin += at_once) {
        OutputBuffer piece;
        write_ply_vertices(piece, mesh, begin, std::min(mesh.n_vertices(), begin + at_once));
        output.write(piece.content(), header.size() + (first_vertex + at(begin)) * bytes_of_vertex);
    }
    std::size_t offset = header.size() + at(counts.vertices) * bytes_of_vertex + first_face_byte;
    for (Index begin = 0; begin < mesh.n_faces(); begin += at_once) {
        OutputBuffer piece;
        write_labelled_ply_faces(piece, mesh, labels, counts.has_long_face, begin,
                                 std::min(mesh.n_faces(), begin + at_once));
        output.write(piece.content(), offset);
        offset += piece.content().size();
    }
}

}  // namespace

void require_slices_of(FileFormat format, const std::filesystem::path& path)
{
    if (is_standard_stream(path) || is_gzip_name(path) || format_of(path) != format)
        throw OptionError(fmt::format(
            "{}: ranks that each have a slice of the mesh write an uncompressed {} file; convert it afterwards",
            path.string(), extension_of(format)));
}

void write_together(Communicator& comm, const std::filesystem::path& path,
                    const std::function<void(const SharedOutput&)>& write_own)
{
    std::optional<SharedOutput> output;
    comm.at_first_rank([&] { output.emplace(path); });
    const std::string temporary = output ? output->temporary().string() : std::string();
    const auto name = comm.gather_all(std::vector<char>(temporary.begin(), temporary.end()));
    if (!output)
        output.emplace(path, std::string(name.begin(), name.end()));
    write_own(*output);
    output->finish();
    // All ranks have written.
    static_cast<void>(comm.gather_all(std::vector<char>{}));
    comm.at_first_rank([&] { output->commit(); });
}

void check_together(Communicator& comm, const std::function<void()>& check)
{
    std::string fault;
    try {
        check();
    } catch (const OutputError& error) {
        fault = error.what() + std::string("\n");
    }
    const auto faults = comm.gather_all(std::vector<char>(fault.begin(), fault.end()));
    comm.at_first_rank([&] {
        if (!faults.empty())
            throw OutputError(std::string(faults.begin(), std::ranges::find(faults, '\n')));
    });
}

std::array<bool, 3> fit_all(Communicator& comm, const std::array<bool, 3>& own)
{
    std::array<bool, 3> fits = {true, true, true};
    for (const auto& of_rank : comm.gather_all(std::vector<std::array<bool, 3>>{own}))
        for (std::size_t k = 0; k < fits.size(); ++k)
            fits[k] = fits[k] && of_rank[k];
    return fits;
}

FilePieces measure_pieces(Index n, std::function<void(Index piece, ByteWriter& file)> make, const Executor& exec)
{
    FilePieces pieces{std::vector<std::size_t>(at(n)), std::move(make)};
    for_each(exec, n, [&](Index i) {
        OutputBuffer piece;
        pieces.make(i, piece);
        pieces.sizes[i] = piece.content().size();
    });
    return pieces;
}

void write_pieces_together(Communicator& comm, const std::filesystem::path& path, std::string_view begin,
                           const FilePieces& own, std::string_view end, const Executor& exec)
{
    std::vector<std::size_t> offsets{0};
    std::partial_sum(own.sizes.begin(), own.sizes.end(), std::back_inserter(offsets));
    const auto bounds = gather_bounds_of(comm, static_cast<std::int64_t>(offsets.back()));
    const std::size_t first = begin.size() + static_cast<std::size_t>(bounds[comm.rank()]);
    write_together(comm, path, [&](const SharedOutput& output) {
        if (comm.rank() == 0) {
            output.write(begin, 0);
            output.write(end, begin.size() + static_cast<std::size_t>(bounds.back()));
        }
        for_each(exec, static_cast<Index>(own.sizes.size()), [&](Index i) {
            OutputBuffer piece;
            own.make(i, piece);
            output.write(piece.content(), first + offsets[i]);
        });
    });
}

Eigen::MatrixXd extremes_of_all(Communicator& comm, const Eigen::MatrixXd& own)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<std::array<double, 3>> of_rank;
    for (const auto& column : own.colwise()) {
        std::array<double, 3>& extremes = of_rank.emplace_back(std::array{infinity, -infinity, 0.0});
        for (const double value : column) {
            extremes[0] = value < extremes[0] ? value : extremes[0];
            extremes[1] = value > extremes[1] ? value : extremes[1];
            extremes[2] = std::isnan(value) ? value : extremes[2];
        }
    }
    Eigen::MatrixXd all(3, own.cols());
    all.colwise() = Eigen::Vector3d(infinity, -infinity, 0.0);
    Eigen::Index i = 0;
    for (const auto& [least, most, no_data] : comm.gather_all(of_rank)) {
        auto column = all.col(i++ % own.cols());
        column[0] = std::min(column[0], least);
        column[1] = std::max(column[1], most);
        column[2] = std::isnan(no_data) ? no_data : column[2];
    }
    for (auto column : all.colwise())
        if (column[0] > column[1])
            column.setConstant(column[2]);
        else if (!std::isnan(column[2]))
            column[2] = column[0];
    return all;
}

void write_labelled_together(Communicator& comm, const std::filesystem::path& path, const PolygonMesh& mesh,
                             const std::vector<Index>& labels)
{
    const auto vertices = gather_bounds_of(comm, mesh.n_vertices());
    const auto faces = gather_bounds_of(comm, mesh.n_faces());
    const auto long_faces = comm.gather_all(std::vector<char>{static_cast<char>(has_long_face(mesh) ? 1 : 0)});
    const PlyCounts counts{static_cast<Index>(vertices.back()), static_cast<Index>(faces.back()),
                           std::ranges::find(long_faces, 1) != long_faces.end()};
    constexpr std::size_t bytes_of_label = 3 + sizeof(std::int32_t);
    const std::size_t bytes = at(mesh.n_faces()) * ((counts.has_long_face ? 4 : 1) + bytes_of_label) +
                              at(mesh.n_corners()) * sizeof(std::int32_t);
    const auto face_bytes = gather_bounds_of(comm, static_cast<std::int64_t>(bytes));
    write_together(comm, path, [&](const SharedOutput& output) {
        write_labelled_range(output, mesh, labels, counts, static_cast<std::size_t>(vertices[comm.rank()]),
                             static_cast<std::size_t>(face_bytes[comm.rank()]));
    });
}

}  // namespace seamflow
