#pragma once

#include <span>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "samples/tiles/tile_files.h"

/// Where the surface continues from one tile to others: as it continues across the seams of one file (see weld).
namespace seamflow {

/// The faces around the border of a mesh.
/// @param topology of it.
TileBorder border_of(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

/// The border of a tile, and where lower tiles have its vertices.
struct BorderOfTile {
    Index tile = 0;
    TileBorder border;
    /// Of tiles below the one in question; ignored for others.
    TileOwners owners;
};

/// Finds the owners of the vertices on the border of a tile. Two edges of one face each are joined where they coincide,
/// run in opposite directions, and no third edge lies there.
/// @param tile that of the border. @param near its border and those of all tiles near it, ascending by tile.
/// @param distance within which vertices coincide, in units of length; 0: their coordinates are equal.
TileOwners owners_of(Index tile, std::span<const BorderOfTile> near, double distance,
                     const Executor& exec = run_serially);

}  // namespace seamflow
