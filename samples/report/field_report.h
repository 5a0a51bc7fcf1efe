#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/diffuse.h"
#include "engine/options/flow_options.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// The values of a field, at the vertices with data.
struct FieldRange {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    double sum = 0.0;
    /// The same in units of 2⁶⁴, which does not overflow.
    double small_sum = 0.0;
    std::int64_t n = 0;

    void add(const FieldRange& other);

    /// 0 without data.
    [[nodiscard]] double mean() const;
};

/// Of each column.
std::vector<FieldRange> ranges_of_columns(const Eigen::MatrixXd& values);

/// What became of fields on a surface.
struct FieldSummary {
    std::vector<std::string> names = {};
    std::int64_t n_vertices = 0;
    /// One for each name; `before` is empty for fields that there were not.
    std::vector<FieldRange> before = {};
    std::vector<FieldRange> after = {};
    FieldReport report = {};
};

/// Prints the amount of smoothing of fields.
void print_field_amount(std::ostream& out, const MeshScale& scale, const FlowOptions& options,
                        const FieldOptions& of_fields);

/// Prints how the flow was solved, remarks, times, the width that was reached, and the range of each field before and
/// after.
void print_fields(std::ostream& out, const RunRecord& run, const FieldSummary& summary);

/// REPORT.json of `smooth --fields` and `smooth --from`.
/// @param options with the amount. See smooth_report_json.
std::string field_report_json(const RunRecord& run, const FlowOptions& options, const FieldSummary& summary);

}  // namespace seamflow
