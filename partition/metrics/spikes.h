#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// A vertex far from all of its neighbours: noise of another kind than that of the others, such as an impulse, or a
/// height that stands for no data.
struct Spike {
    Index vertex = 0;
    /// Its distance from the nearest neighbour, in lengths of the longest edge between its neighbours.
    double distance = 0.0;
};

/// The vertices whose edges are all longer than ten times the other edges of their faces, and than three times the
/// diagonal of the box around their neighbours, ascending: the middle of a disc or the tip of a cone are none. Takes
/// about as long as measuring all edges.
/// @param positions #V by 3.
std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The corner of a face whose two edges are both more than ten times as long as its others, as at a spike; -1 if there
/// is none.
/// @param corners the face. @param positions #V by 3.
Index needle_tip(std::span<const Index> corners, const Points& positions);

/// The spikes among some vertices, ascending.
/// @param tips all that are a needle_tip of a face, in any order, perhaps repeated.
std::vector<Spike> spikes_among(const PolygonMesh& mesh, const Points& positions, std::vector<Index> tips);

/// A sentence about them for the user.
/// @param spikes at least one.
std::string remark_on_spikes(const std::vector<Spike>& spikes);

}  // namespace seamflow
