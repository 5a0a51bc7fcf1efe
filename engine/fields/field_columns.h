#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/measure/flow_report.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "solvers/laplacian/laplacian.h"

/// Fields that diffuse, column by column.
namespace seamflow {

/// Columns that have data at the same vertices.
struct FieldGroup {
    std::vector<Eigen::Index> columns;
    /// #V: 1 at vertices without data.
    std::vector<std::uint8_t> lacks;
    Index n_lacking = 0;
};

/// Groups the columns. Groups are in the order of their first columns; columns ascend within a group.
/// @param fields #V by n; NaN is no data.
std::vector<FieldGroup> group_columns(const Eigen::MatrixXd& fields);

/// @throws InputError for another number of rows, or infinite values.
void require_fields_of(Index n_vertices, const Eigen::MatrixXd& fields);

/// Whether a face has so little area for the length of its edges that rounding errors of its entries of K would
/// outweigh M in the long steps of distances and of extensions. Faces without area (see has_area) are thin.
bool is_thin(std::span<const Index> face, const Points& positions);

/// Whether the K of a face cannot be used: the face is thin (see is_thin), and the Laplacian divides by areas of faces.
bool is_unusable(const PolygonMesh& mesh, Index f, Laplacian laplacian);

/// The range of the values of a column; if there are no values, the least exceeds the most.
struct ValueRange {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};

/// The range of each column of the group, over the vertices with data.
std::vector<ValueRange> ranges_of(const Eigen::MatrixXd& fields, const FieldGroup& group, const Executor& exec);

/// Columns, each divided by its unit: a power of two, so that division is exact, with which its values spread over
/// about √dt. Steps move positions over about this distance, and steppers, which are made for positions, compute
/// updates of this size in single precision.
class ScaledFields {
  public:
    /// @param values #V by the columns of the group. @param ranges of these columns (see ranges_of).
    /// @param time_step in length².
    ScaledFields(Eigen::MatrixXd values, const FieldGroup& group, std::span<const ValueRange> ranges, double time_step,
                 const Executor& exec);

    /// The scaled values; 0 at vertices without data.
    Eigen::MatrixXd& values() { return values_; }

    /// A copy of the values, in the units of the given columns.
    [[nodiscard]] Eigen::MatrixXd in_units() const;

    /// Moves out the values, in the units of the given columns, NaN at vertices that have no data now.
    /// @throws ComputationError naming a column with values that are not finite.
    [[nodiscard]] Eigen::MatrixXd take(const FieldGroup& group, const Executor& exec);

  private:
    Eigen::MatrixXd values_;
    /// Per column: its unit, by which it is divided.
    Eigen::VectorXd units_;
};

/// Clamps values to the range of their column: rounding errors, and errors of a solution to a tolerance, leave it.
void keep_within(std::span<const ValueRange> ranges, const FieldGroup& group, Eigen::MatrixXd& fields,
                 const Executor& exec);

/// The number of times that the steps of the flow are taken: once for every three columns.
int n_blocks(Eigen::Index n_columns);

/// Adds the report on earlier columns, except remarks: sentences on choices once each, in their order. The number of
/// steps that miss their tolerance is the largest over the columns.
void add_up(const FlowReport& before, FlowReport& report);

/// The remarks of all groups, each once, in their order. A remark that some groups do not have begins with the columns
/// that it concerns.
/// @param of_groups one list for each group. @param names of the columns; empty: columns are called by their
/// numbers.
std::vector<Remark> remarks_on(std::span<const FieldGroup> groups, std::span<const std::vector<Remark>> of_groups,
                               std::span<const std::string> names);

}  // namespace seamflow
