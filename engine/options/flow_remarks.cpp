#include "engine/options/flow_remarks.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>

namespace seamflow {

void remark_on_drift(const FlowOptions& options, FlowReport& report)
{
    if (report.steps.empty() || report.steps.back().estimated_v_max.value_or(0.0) <= 1.0)
        return;
    char estimate[32];
    std::snprintf(estimate, sizeof estimate, "%.2g", *report.steps.back().estimated_v_max);
    report.remarks.push_back("The result is, by estimate, up to " + std::string(estimate) +
                             " mean edge lengths away from the undecomposed flow: " +
                             (options.accuracy.tolerance
                                  ? "a smaller tolerance brings it closer."
                                  : "fewer sub-meshes bring it closer; --converge "
                                    "(AccuracyOptions::tolerance) gives the undecomposed step itself."));
}

void remark_on_near_singularity(std::span<const Index> n_nearly_singular, FlowReport& report)
{
    const auto first = std::ranges::find_if(n_nearly_singular, [](Index n) { return n > 0; });
    if (first == n_nearly_singular.end())
        return;
    const Index total = std::accumulate(first, n_nearly_singular.end(), Index{0});
    report.remarks.push_back("The equations of sub-meshes were nearly singular " + std::to_string(total) +
                             (total == 1 ? " time" : " times") + ", first among them sub-mesh " +
                             std::to_string(first - n_nearly_singular.begin()) +
                             ": the result may be wrong there; use a smaller time step, or another Laplacian.");
}

void remark_on_factorisation(Factorisation asked, std::span<const Factorisation> used, FlowReport& report)
{
    const auto n = std::ranges::count_if(used, [&](Factorisation kind) { return kind != asked; });
    if (asked == Factorisation::Automatic || n == 0)
        return;
    const std::string why = asked == Factorisation::Cholmod
                                ? "by UMFPACK, not by CHOLMOD, because their equations are not symmetric."
                                : "by UMFPACK, because pivots from the diagonal were too small.";
    report.remarks.push_back(std::to_string(n) + " of " + std::to_string(used.size()) + " sub-meshes were factorised " +
                             why);
}

void remark_on_missed_tolerance(int iterations, const std::string& remedy, FlowReport& report)
{
    const auto steps = [](int n) { return std::to_string(n) + (n == 1 ? " step" : " steps"); };
    if (report.steps_short_of_tolerance == 0)
        return;
    std::string remark = "The tolerance was not reached in " + steps(report.steps_short_of_tolerance) + " with " +
                         std::to_string(iterations) + " iterations at most";
    if (report.steps_stagnated > 0)
        remark += "; in " + std::to_string(report.steps_stagnated) + " of them more would not have helped";
    report.remarks.push_back(remark + (remedy.empty() ? "" : ": " + remedy) + ".");
}

double extent_of(const Points& positions)
{
    return positions.rows() == 0 ? 0.0 : (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

void remark_on_collapse(double extent_before, const Points& after, FlowReport& report)
{
    constexpr double next_to_nothing = 1e-3;
    const double extent = extent_of(after);
    if (extent >= next_to_nothing * extent_before)
        return;
    char part[32];
    std::snprintf(part, sizeof part, "%.1g", extent / extent_before);
    report.remarks.push_back("The surface has shrunk to " + std::string(part) +
                             " of its extent: smaller or fewer steps leave more of it.");
}

}  // namespace seamflow
