#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// Whose positions stand for the undecomposed flow.
enum class Reference {
    /// Direct up to two million vertices (300,000 for Ptáčková-Velho, whose factors are larger); beyond, and where that
    /// fails, Iterative.
    Automatic,
    /// One factorisation of the whole mesh: CHOLMOD, for Ptáčková-Velho UMFPACK.
    Direct,
    /// Conjugate gradients (BiCGSTAB) to 1e-12.
    Iterative,
    /// No distances, and no rows at equal accuracy.
    None,
};

/// What is held beside what.
struct CaseOptions {
    /// Of all methods; `threads` at least 1.
    FlowOptions flow;
    std::vector<Method> peers;
    Reference reference = Reference::Automatic;
    /// See MethodTask.
    std::vector<int> simulated_threads;
};

/// One method with one tolerance.
struct Row {
    /// As in the table and in JSON: "ours", "cholmod", "cg-1e-8", "cg-equal-accuracy", "cg-equal-both", …
    std::string name;
    MethodTask task;
    /// Without the positions.
    MethodResult result;
    /// Distance to the undecomposed flow after all steps, in mean edge lengths of its mesh.
    std::optional<double> v_mean;
    std::optional<double> v_max;

    [[nodiscard]] bool succeeded() const { return result.error.empty(); }
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
