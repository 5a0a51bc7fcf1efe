#include "engine/measure/flow_remarks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace seamflow {

void remark_on_drift(FlowReport& report)
{
    if (report.steps.empty() || report.steps.back().estimated_v_max.value_or(0.0) <= 1.0)
        return;
    const double distance = *report.steps.back().estimated_v_max;
    report.remarks.push_back(
        {"drift",
         {{"mean edge lengths", distance}},
         {fmt::format("The result is, by estimate, up to {:.2g} mean edge lengths away from the undecomposed flow: {}",
                      distance,
                      report.convergence.tolerance
                          ? "a smaller tolerance brings it closer."
                          : "fewer sub-meshes bring it closer; <tolerance> gives the undecomposed step itself.")}});
}

void remark_on_near_singularity(FlowReport& report)
{
    const std::vector<SubMeshReport>& all = report.cut.sub_meshes;
    const auto first = std::ranges::find_if(all, [](const SubMeshReport& one) { return one.n_nearly_singular > 0; });
    if (first == all.end())
        return;
    Index total = 0;
    for (const SubMeshReport& one : all)
        total += one.n_nearly_singular;
    report.remarks.push_back(
        {"nearly singular",
         {{"times", total}, {"first sub-mesh", first - all.begin()}},
         {fmt::format("The equations of sub-meshes were nearly singular {} {}, first among them sub-mesh {}: the "
                      "result may be wrong there; use a smaller time step, or another Laplacian.",
                      total, total == 1 ? "time" : "times", first - all.begin())}});
}

void remark_on_factorisation(Factorisation asked, FlowReport& report)
{
    std::vector<Factorisation> others;
    Index n_factorised = 0;
    for (const SubMeshReport& one : report.cut.sub_meshes) {
        n_factorised += one.factorisation != Factorisation::Automatic ? 1 : 0;
        if (one.factorisation != Factorisation::Automatic && one.factorisation != asked)
            others.push_back(one.factorisation);
    }
    if (asked == Factorisation::Automatic || others.empty())
        return;
    const bool is_eigen = others.front() == Factorisation::Eigen;
    report.remarks.push_back(
        {"other factorisation",
         {{"sub-meshes", others.size()}, {"of", n_factorised}},
         {fmt::format("{} of {} sub-meshes were factorised by {}, {}.", others.size(), n_factorised,
                      is_eigen ? "Eigen" : "UMFPACK",
                      asked == Factorisation::Cholmod ? "not by CHOLMOD, because their equations are not symmetric"
                                                      : "because pivots from the diagonal were too small")}});
}

void remark_on_missed_tolerance(int iterations, FlowReport& report)
{
    const int n_short = report.convergence.steps_short_of_tolerance;
    const int n_stagnated = report.convergence.steps_stagnated;
    if (n_short == 0)
        return;
    std::string remark = fmt::format("The tolerance was not reached in {} {} with {} iterations at most", n_short,
                                     n_short == 1 ? "step" : "steps", iterations);
    if (n_stagnated > 0)
        remark += fmt::format("; in {} of them more would not have helped", n_stagnated);
    report.remarks.push_back({"missed tolerance",
                              {{"steps", n_short}, {"iterations", iterations}, {"stagnated", n_stagnated}},
                              {remark + "."}});
}

}  // namespace seamflow
