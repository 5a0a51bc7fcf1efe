#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/distributed/ranks/communicator.h"
#include "partition/executor.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/byte_writer.h"
#include "partition/io/shared_output.h"
#include "partition/polygon_mesh.h"

/// Files that ranks write together. All of them call these functions together.
namespace seamflow {

/// Checks that a file of which every rank writes a slice has the format that these are of.
/// @throws OptionError
void require_slices_of(FileFormat format, const std::filesystem::path& path);

/// Rank 0 makes the file, all write their slices, and rank 0 gives it its name.
/// @throws OutputError
void write_together(Communicator& comm, const std::filesystem::path& path,
                    const std::function<void(const SharedOutput&)>& write_own);

/// Throws on all ranks if a result is wrong on any: the OutputError of the lowest such rank.
void check_together(Communicator& comm, const std::function<void()>& check);

/// Whether the types of a file can hold the coordinates x, y and z of all ranks. @param own those of this rank.
std::array<bool, 3> fit_all(Communicator& comm, const std::array<bool, 3>& own);

/// What decides about the types of columns of all ranks: the least and the largest value of each, and NaN if there is
/// any.
/// @returns 3 by n.
Eigen::MatrixXd extremes_of_all(Communicator& comm, const Eigen::MatrixXd& own);

/// This rank's share of a file: consecutive pieces, which follow those of the ranks before it.
struct FilePieces {
    /// In bytes, each.
    std::vector<std::size_t> sizes;
    /// Makes one of them; several at a time.
    std::function<void(Index piece, ByteWriter& file)> make;
};

/// Makes each of n pieces once to see how long it is, so that none has to be kept until all are known.
FilePieces measure_pieces(Index n, std::function<void(Index piece, ByteWriter& file)> make, const Executor& exec);

/// As write_together, with `begin` before the pieces of all ranks and `end` after them, which rank 0 writes.
void write_pieces_together(Communicator& comm, const std::filesystem::path& path, std::string_view begin,
                           const FilePieces& own, std::string_view end, const Executor& exec);

/// As write_labelled_ply, of a mesh of which every rank has a range.
/// @param mesh of this rank's range, with corners numbered in the whole mesh. @param labels of its faces.
void write_labelled_together(Communicator& comm, const std::filesystem::path& path, const PolygonMesh& mesh,
                             const std::vector<Index>& labels);

}  // namespace seamflow
