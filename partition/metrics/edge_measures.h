#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// A vertex far from all of its neighbours, or a vertex of a block that is far from all vertices around it: noise of
/// another kind than at other vertices, such as an impulse, or heights that stand for missing data.
struct Spike {
    Index vertex = 0;
    /// The distance of its block from the nearest neighbour, in units of the longest edge between the neighbours.
    double distance = 0.0;
};

/// The measures of edges that need all edges to be visited, once.
struct EdgeMeasures {
    /// The mean length of the half-edges, without those of spikes if these change it much (see mean_edge_length).
    double mean = 0.0;
    /// The vertices far from all of their neighbours (see find_spikes).
    std::vector<Spike> spikes;
};

/// Measures all edges.
/// @param positions #V by 3.
EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The vertices whose edges are all longer than ten times the other edges of their faces, and longer than three times
/// the diagonal of the box around their neighbours, ascending: the middle of a disc and the tip of a cone are not among
/// them. Vertices joined by short edges count as one, if they are at most a tenth of the surface beside them. Takes
/// about as long as measuring all edges, and several times as long where there are long faces.
/// @param positions #V by 3.
std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// Positions in which spikes are among their neighbours: each spike moves to the mean of those neighbours that are no
/// spikes, or have already been moved.
/// @param spikes ascending. @param positions #V by 3.
Points without_spikes(const PolygonMesh& mesh, const Topology& topology, const std::vector<Spike>& spikes,
                      const Points& positions);

/// A sentence about spikes for the user.
/// @param spikes at least one.
Remark remark_on_spikes(const std::vector<Spike>& spikes);

}  // namespace seamflow
