#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/fields/diffuse.h"
#include "engine/options/flow_options.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// What became of fields on a surface.
struct FieldSummary {
    std::vector<std::string> names;
    /// #V by names; `before` is empty for fields that there were not.
    Eigen::MatrixXd before = Eigen::MatrixXd(0, 0);
    Eigen::MatrixXd after = Eigen::MatrixXd(0, 0);
    FieldReport report;
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
