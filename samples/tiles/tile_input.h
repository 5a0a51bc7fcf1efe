#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"
#include "partition/metrics/bounding_box.h"
#include "samples/report/mesh_scale.h"
#include "samples/tiles/tile_files.h"

/// The files of tiles, and what is measured of them.
namespace seamflow {

/// What is known of a tile while it is on the disk.
struct TileSummary {
    std::filesystem::path path;
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;
    std::int64_t n_corners = 0;
    /// See mean_edge_length; in length.
    double mean_edge = 0.0;
    /// Around the vertices that faces use.
    BoundingBox box;
    /// Of positions and faces.
    std::uint64_t checksum = 0;
};

/// A tile as it was read.
struct TileInput {
    MeshFile file;
    FaultLog left_out{.of_faces_alone = true};
};

/// Reads a tile. Faces that cannot be used are left out.
/// @throws InputError (see read_mesh), also for a file without faces.
TileInput read_tile(const std::filesystem::path& path, const Executor& exec);

TileSummary summary_of(const std::filesystem::path& path, const PolygonMesh& mesh, const Executor& exec);

/// The size of the surface of all tiles.
MeshScale scale_of(std::span<const TileSummary> tiles);

/// Keeps the faces, the border and the positions of a tile as its input.
/// @param mesh is used up.
void keep_input(const TileFolder& folder, Index tile, PolygonMesh& mesh, const Executor& exec);

/// Finds the owners of all vertices on borders, and moves vertices that coincide to one place.
/// @param weld the distance within which they coincide, in units of length; empty: none do.
/// @param run gets the numbers of vertices on borders.
void join_tiles(const TileFolder& folder, std::span<const TileSummary> tiles, const std::optional<LengthOnMesh>& weld,
                TileRun& run, const Executor& exec);

/// Checksum of all that determines the result of a run: its options, the names of the tiles and their meshes.
/// @param options with the amount in length².
std::uint64_t identify(std::span<const TileSummary> tiles, const FlowOptions& options);

}  // namespace seamflow
