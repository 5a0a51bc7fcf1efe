#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/distributed/cut/joined_seams.h"
#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/io/fault_log.h"
#include "samples/command/smooth_command.h"
#include "samples/report/run_record.h"

/// The inputs of a run of ranks besides the mesh, and how they are shared. Rank 0 reads them; all ranks call these
/// functions together.
namespace seamflow {

/// How many threads a rank has: the ranks on a machine share its cores.
/// @param host the machine of this rank.
int threads_of_rank(Communicator& comm, const std::string& host, const SmoothCommand& command);

/// The labels of --labels for the faces of this rank's range.
/// @param faults of the mesh, whose faces that are left out have labels in the file. @param bounds of faces.
std::vector<Index> read_labels(Communicator& comm, const SmoothCommand& command, const FaultLog& faults,
                               std::span<const std::int64_t> bounds);

/// The vertices of --fix, ascending, at all ranks.
std::vector<std::int64_t> read_fixed(Communicator& comm, const SmoothCommand& command, std::int64_t n_vertices);

/// Holds vertices of a part.
/// @param fixed ascending; gets those that vertices along seams move with, too.
void hold_in_part(const JoinedSeams& seams, std::vector<std::int64_t>& fixed, MeshPart& part);

/// The weights of --attach-weights, #V of the whole mesh at rank 0; empty elsewhere, and without that option.
std::vector<double> read_weights(Communicator& comm, const SmoothCommand& command, std::int64_t n_vertices);

/// The strengths of --region and --feather, #V of the whole mesh at rank 0; empty elsewhere, and without a region.
/// @param whole the mesh at rank 0; null: it has not read all of it, so that there is no --feather.
/// @param run as for feather.
std::vector<double> read_strengths(Communicator& comm, const SmoothCommand& command, const PolygonMesh* whole,
                                   RunRecord& run, std::int64_t n_vertices);

/// What numbers of vertices that move as one become.
enum class OfSeam { Least, Largest };

/// The numbers of the vertices of a part: vertices of a seam get the least or largest of all that move as one.
/// @param of_all #V at rank 0 (see read_weights). @param numbers of the vertices, ascending. @param bounds of vertices.
/// @returns empty if rank 0 has none.
std::vector<double> deal_to_vertices(Communicator& comm, std::vector<double> of_all, const JoinedSeams& seams,
                                     OfSeam of_seam, std::span<const std::int64_t> numbers,
                                     std::span<const std::int64_t> bounds);

}  // namespace seamflow
