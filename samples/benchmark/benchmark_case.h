#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// What is held beside what.
struct CaseOptions {
    /// Of all methods; `threads` at least 1.
    FlowOptions flow;
    std::vector<Method> peers;
    Reference reference = Reference::Automatic;
    /// See MethodTask.
    std::vector<int> simulated_threads;
};

/// What was found for one mesh.
struct CaseResult {
    Index vertices = 0;
    Index faces = 0;
    /// Name of the row whose positions are the reference, with its tolerance if it has one; empty: none.
    std::string reference;
    Row ours;
    /// The same in one thread, where a peer takes no more and ours had more.
    std::optional<Row> ours_one_thread;
    std::vector<Row> peers;
};

/// Time per step of a peer, in that of ours with as many threads as ours had.
double ratio(const CaseResult& result, const Row& peer);

/// Time per step of a peer that takes one thread, in that of ours with one; nothing for other peers.
std::optional<double> ratio_one_thread(const CaseResult& result, const Row& peer);

/// Runs ours, the reference and the peers, each in a process of its own.
/// @param on_row called for each row as soon as it is known, ours first.
/// @throws ComputationError if ours or the reference fails; a peer that fails is a row that says so.
CaseResult run_case(const PolygonMesh& mesh, const CaseOptions& options, const std::function<void(const Row&)>& on_row);

}  // namespace seamflow
