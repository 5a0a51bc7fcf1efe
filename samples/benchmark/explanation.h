#pragma once

#include <iosfwd>

#include "samples/benchmark/method_rows.h"
#include "samples/benchmark/table.h"

namespace seamflow {

/// Prints the constants of the cost model by which ours chooses its approach, and the head of a table of approaches.
Table explanation_table(std::ostream& out);

/// The reasons for the approach of ours: the predictions of the cost model for each approach, and the measurements of
/// each, in a process of its own.
/// @param name of the mesh.
/// @param flow of a symmetric Laplacian.
void add_explanation(Table& table, const std::string& name, const PolygonMesh& mesh, const FlowOptions& flow);

}  // namespace seamflow
