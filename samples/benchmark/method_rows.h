#pragma once

#include <optional>
#include <string>

#include "samples/benchmark/methods/method.h"
#include "samples/benchmark/scratch_folder.h"
#include "samples/benchmark/turns.h"

namespace seamflow {

/// The method whose positions represent the undecomposed flow.
enum class Reference {
    /// Direct up to two million vertices (300,000 for Ptáčková-Velho, whose factors are larger); for larger meshes, and
    /// if that fails, Iterative.
    Automatic,
    /// One factorisation of the whole mesh: CHOLMOD, for Ptáčková-Velho UMFPACK.
    Direct,
    /// Conjugate gradients (BiCGSTAB) to 1e-12.
    Iterative,
    /// No distances, and no rows at equal accuracy.
    None,
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
    /// Seconds from the beginning of set-up to the end of the last step of each run, in a grid; from file to file in a
    /// WholeRun; else empty.
    Turns turns;

    [[nodiscard]] bool succeeded() const { return result.error.empty(); }
};

/// Runs methods on one mesh, each in a process of its own, and measures how far from the undecomposed flow they end.
/// Only one object at a time, because of its ScratchFolder.
class MethodRows {
  public:
    /// @param mesh must outlive this.
    explicit MethodRows(const PolygonMesh& mesh);

    /// A task of a peer with the threads that it can use.
    [[nodiscard]] static MethodTask task_of(Method method, const FlowOptions& flow, double tolerance = 0.0);

    /// Returns a row with its positions, without its distance.
    [[nodiscard]] Row run(const MethodTask& task) const;

    /// Runs the method that gives the undecomposed flow for these options, which replaces the previous one.
    /// @throws ComputationError if it fails.
    void find_reference(Reference wanted, const FlowOptions& flow);

    /// The row of the reference; empty with Reference::None.
    [[nodiscard]] const std::optional<Row>& reference() const { return reference_row_; }

    /// Replaces the positions of a row by distances.
    void measure(Row& row) const;

    [[nodiscard]] const PolygonMesh& mesh() const { return mesh_; }
    [[nodiscard]] const ScratchFolder& scratch() const { return scratch_; }

  private:
    [[nodiscard]] bool is_small_enough_to_factorise(Laplacian laplacian) const;

    const PolygonMesh& mesh_;
    ScratchFolder scratch_;
    std::optional<Row> reference_row_;
    Points reference_ = Points(0, 3);
};

/// @throws ComputationError if a row did not succeed.
void require_success(const Row& row);

}  // namespace seamflow
