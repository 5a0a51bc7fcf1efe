#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// A vertex far from all of its neighbours, or one of a block of vertices that is far from all around it: noise of
/// another kind than that of the others, such as an impulse, or heights that stand for no data.
struct Spike {
    Index vertex = 0;
    /// The distance of its block from the nearest neighbour, in lengths of the longest edge between those.
    double distance = 0.0;
};

/// The vertices whose edges are all longer than ten times the other edges of their faces, and than three times the
/// diagonal of the box around their neighbours, ascending: the middle of a disc or the tip of a cone are none. Vertices
/// joined by short edges count as one, if they are at most a tenth of the surface beside them. Takes about as long as
/// measuring all edges, and several times as long where there are long faces.
/// @param positions #V by 3.
std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// Whether the longest edge of a face is more than ten times as long as the shortest: where no face is so, no vertex is
/// a spike.
/// @param corners the face. @param positions #V by 3.
bool has_needle(std::span<const Index> corners, const Points& positions);

/// The same as find_spikes, of a mesh that has needles.
std::vector<Spike> spikes_at_needles(const PolygonMesh& mesh, const Points& positions);

/// Positions in which spikes are among their neighbours: each at the mean of those that are none, or have their place
/// already.
/// @param spikes ascending. @param positions #V by 3.
Points without_spikes(const PolygonMesh& mesh, const Topology& topology, const std::vector<Spike>& spikes,
                      const Points& positions);

/// Names the farthest of them.
/// @param spikes at least one.
Remark remark_on_spikes(const std::vector<Spike>& spikes);

}  // namespace seamflow
