#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/polygon_mesh.h"
#include "samples/options/all_options.h"

namespace seamflow::test {

/// A value of an option that is not the default, and what else it takes to have an effect.
struct OptionCase {
    /// See option_table.
    std::string_view field;
    std::string_view value;
    /// @param edge mean edge length of the mesh.
    std::function<void(AllOptions& options, const PolygonMesh& mesh, double edge)> set;

    [[nodiscard]] std::string name() const { return std::string(field) + " " + std::string(value); }
};

/// One or more for each option; a test compares them with the table of options.
const std::vector<OptionCase>& option_cases();

/// The one of this name.
const OptionCase& option_case(std::string_view name);

/// Without any case: steps of one squared mean edge length that are converged as far as rounding lets them.
AllOptions options_without_cases(double edge);

}  // namespace seamflow::test
