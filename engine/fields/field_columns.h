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

/// Columns whose data are at the same vertices.
struct FieldGroup {
    std::vector<Eigen::Index> columns;
    /// #V: 1 at vertices without data.
    std::vector<std::uint8_t> lacks;
    Index n_lacking = 0;
};

/// Groups in the order of their first columns, which ascend in each.
/// @param fields #V by n; NaN is no data.
std::vector<FieldGroup> group_columns(const Eigen::MatrixXd& fields);

/// @throws InputError for another number of rows, or infinite values.
void require_fields_of(Index n_vertices, const Eigen::MatrixXd& fields);

/// Whether a face has next to no area for the length of its edges: the entries of its K would be so large that their
/// rounding errors outweigh M in steps as long as those of distances and of what is extended. Faces without area (see
/// has_area) are thin.
bool is_thin(std::span<const Index> face, const Points& positions);

/// Whether K of a face cannot be used: it has no area.
bool is_unusable(const PolygonMesh& mesh, Index f, Laplacian laplacian);

/// Of the values of a column; the least exceeds the most if there are none.
struct ValueRange {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};

/// One for each column of the group, over the vertices with data.
std::vector<ValueRange> ranges_of(const Eigen::MatrixXd& fields, const FieldGroup& group, const Executor& exec);

/// Columns in the unit in which their values spread about as far as the steps do, which powers of two change exactly:
/// what steps add fits in single precision.
class ScaledFields {
  public:
    /// @param values #V by the columns of the group. @param ranges of the whole mesh (see ranges_of).
    /// @param time_step in length².
    ScaledFields(Eigen::MatrixXd values, const FieldGroup& group, std::span<const ValueRange> ranges, double time_step,
                 const Executor& exec);

    /// 0 where there are no data.
    Eigen::MatrixXd& values() { return values_; }

    [[nodiscard]] Eigen::MatrixXd in_units() const;

    /// The values in their own units, NaN at vertices that lack data now. There are none here afterwards.
    /// @throws ComputationError naming a column with values that are not finite.
    [[nodiscard]] Eigen::MatrixXd take(const FieldGroup& group, const Executor& exec);

  private:
    Eigen::MatrixXd values_;
    Eigen::VectorXd units_;
};

/// Moves values that are out of the range of their column into it: rounding errors, and those of a solution to a
/// tolerance.
void keep_within(std::span<const ValueRange> ranges, const FieldGroup& group, Eigen::MatrixXd& fields,
                 const Executor& exec);

/// How many times the steps of the flow are taken: once for each three columns.
int n_blocks(Eigen::Index n_columns);

/// Adds what was reported on columns before, except remarks: choices once each, in their order. Steps that
/// miss their tolerance are those of the columns that miss it most often.
void add_up(const FlowReport& before, FlowReport& report);

/// The remarks of all groups, once each, in their order. One that other groups are without begins with the columns that
/// it is about.
/// @param of_groups one list for each group. @param names see FieldOptions.
std::vector<Remark> remarks_on(std::span<const FieldGroup> groups, std::span<const std::vector<Remark>> of_groups,
                               std::span<const std::string> names);

}  // namespace seamflow
