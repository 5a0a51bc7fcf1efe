#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "samples/page/packed_state.h"

namespace seamflow {

/// A field on the surface of a page, before and after the run, on one scale.
struct PageField {
    std::string name;
    /// Red, green and blue together. Their packed bytes are three per vertex, grey without data.
    bool is_colour = false;
    /// Whether a vertex has data, and whether one has none, before or after.
    bool has_data = false;
    bool has_gaps = false;
    /// Of all data, before and after; 0 without any. Of colours: what stands for none and for full brightness.
    double least = 0.0;
    double most = 0.0;
    /// Between these are 98 % of the data.
    double percentile_1 = 0.0;
    double percentile_99 = 0.0;
    /// (value - least) / (most - least) of each vertex; not finite without data.
    PackedValues before = {};
    PackedValues after = {};
};

/// What a page shows of a surface that stays.
struct PageFields {
    std::vector<PageField> fields;
    /// Whether they are distances along the surface, which lines of equal distance explain. There is no `before`.
    bool are_distances = false;
    /// How many steps lead from before to after.
    int steps = 0;
    /// See field_report_json.
    std::string report_json;
};

/// Fields as a page has them: red, green and blue become one, which comes first.
/// @param before, after #V by names, finite or NaN, which is no data; `before` is empty for fields that there were not.
std::vector<PageField> pack_fields(const std::vector<std::string>& names, const Eigen::MatrixXd& before,
                                   const Eigen::MatrixXd& after);

}  // namespace seamflow
