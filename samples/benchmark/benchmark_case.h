#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// The methods to compare, and how.
struct CaseOptions {
    /// Of all methods; `threads` at least 1.
    FlowOptions flow;
    std::vector<Method> peers;
    Reference reference = Reference::Automatic;
    /// See MethodTask.
    std::vector<int> simulated_threads;
};

/// The results for one mesh.
struct CaseResult {
    Index vertices = 0;
    Index faces = 0;
    /// Name of the row whose positions are the reference, with its tolerance if it has one; empty: none.
    std::string reference;
    Row ours;
    /// Ours in one thread, if a peer takes no more and ours had more.
    std::optional<Row> ours_one_thread;
    std::vector<Row> peers;
};

/// Time per step of a peer, divided by that of ours with as many threads as ours had.
double ratio(const CaseResult& result, const Row& peer);

/// Time per step of a peer that takes one thread, divided by that of ours with one; empty for other peers.
std::optional<double> ratio_one_thread(const CaseResult& result, const Row& peer);

/// Runs ours, the reference and the peers, each in a process of its own.
/// @param on_row called for each row as soon as it is known, ours first.
/// @throws ComputationError if ours or the reference fails; the row of a peer that fails has the error.
CaseResult run_case(const PolygonMesh& mesh, const CaseOptions& options, const std::function<void(const Row&)>& on_row);

}  // namespace seamflow
