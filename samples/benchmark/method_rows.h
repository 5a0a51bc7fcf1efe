#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "samples/benchmark/methods/method.h"
#include "samples/benchmark/scratch_folder.h"

namespace seamflow {

/// One method with one tolerance.
struct Row {
    MethodTask task;
    /// Without the positions.
    MethodResult result;
    /// Distance to the undecomposed flow after all steps, in mean edge lengths of its mesh.
    std::optional<double> v_mean;
    std::optional<double> v_max;
    /// Seconds of each run: from the beginning of set-up to the end of the last step; in a whole run from file to file.
    std::vector<double> turns;

    [[nodiscard]] bool succeeded() const { return result.error.empty(); }
    /// The median of the turns.
    [[nodiscard]] double seconds() const;
    /// The method, with the approach of ours or the tolerance of an iterative one: "ours by sweep", "cg to 1e-03".
    [[nodiscard]] std::string name() const;
    /// The members of a row of the table: "method" with "error", or with "tolerance" or "approach", "setup_s",
    /// "step_s", "all_s" (the median of "turns_s"), "peak_memory_mb", "threads", "iterations", "v_mean" and "v_max".
    [[nodiscard]] nlohmann::ordered_json json() const;
};

/// Runs methods on one mesh, each in a process of its own, and measures how far from the undecomposed flow they end.
/// Only one object at a time, because of its ScratchFolder.
class MethodRows {
  public:
    /// @param mesh must outlive this.
    explicit MethodRows(const PolygonMesh& mesh);

    /// A task of a peer with the threads that it can use, without files.
    [[nodiscard]] static MethodTask task_of(Method method, const FlowOptions& flow, double tolerance = 0.0);

    /// Runs a method, and measures how far it ends from the undecomposed flow, if that is known.
    [[nodiscard]] Row run(const MethodTask& task) const;

    /// Takes the undecomposed flow for these options, which replaces the previous one: by one factorisation, or, above
    /// two million vertices or if that fails, by conjugate gradients to 1e-12.
    /// @throws ComputationError if it fails.
    void find_reference(const FlowOptions& flow);

    /// The row of the undecomposed flow; empty: unknown.
    [[nodiscard]] const std::optional<Row>& reference() const { return reference_row_; }

    /// Sets the distances of a row whose method has left its positions in a file.
    void measure(Row& row, const std::filesystem::path& output) const;

    [[nodiscard]] const PolygonMesh& mesh() const { return mesh_; }
    [[nodiscard]] const ScratchFolder& scratch() const { return scratch_; }

  private:
    /// @returns without distances.
    [[nodiscard]] Row run_task(MethodTask task) const;

    const PolygonMesh& mesh_;
    ScratchFolder scratch_;
    std::filesystem::path input_;
    std::filesystem::path output_;
    std::optional<Row> reference_row_;
    Points reference_ = Points(0, 3);
};

/// @throws ComputationError if a row did not succeed.
void require_success(const Row& row);

}  // namespace seamflow
