#include "engine/measure/remarks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace seamflow {

Remark remark_on_repeated_faces(std::int64_t n)
{
    return {"repeated faces",
            {{"faces", n}},
            {fmt::format("{} {} the same vertices as an earlier one and took no part in the flow, but stayed in the "
                         "mesh.",
                         n, n == 1 ? "face has" : "faces have")}};
}

Remark remark_on_non_manifold_vertices(std::int64_t n, std::string_view remedy)
{
    std::string remark = fmt::format("{} held fixed because the mesh is not manifold there.",
                                     n == 1 ? "1 vertex is" : fmt::format("{} vertices are", n));
    if (!remedy.empty())
        remark += fmt::format(" {}, those on edges of three faces or more would flow.", remedy);
    return {"not manifold", {{"vertices", n}}, {remark}};
}

Remark remark_on_junctions(std::int64_t n, Laplacian laplacian)
{
    const bool depends_on_faces = laplacian == Laplacian::Fujiwara || laplacian == Laplacian::Uniform;
    return {"junctions",
            {{"vertices", n}},
            {fmt::format("{} on edges of three faces or more {} with all of these faces.{}",
                         n == 1 ? "1 vertex" : fmt::format("{} vertices", n), n == 1 ? "flows" : "flow",
                         depends_on_faces ? " Angles between sheets tend to 120 degrees with <laplacian "
                                            "virtual-refinement>."
                                          : "")}};
}

Remark remark_on_undefined_vertices(std::int64_t n, std::int64_t first, Laplacian laplacian)
{
    const bool lengths = traits_of(laplacian).divisor == Divisor::EdgeLengths;
    return {"undefined Laplacian",
            {{"vertices", n}, {"first", first}},
            {fmt::format("{} held fixed because {} leave the Laplacian undefined there, vertex {} (numbered from 0) "
                         "among them: inspect lists them.",
                         n == 1 ? "1 vertex is" : fmt::format("{} vertices are", n),
                         lengths ? "edges without length" : "faces without area", first)}};
}

Remark remark_on_unmoving_mesh(Boundary boundary)
{
    const std::string why = "No vertex can flow: each is fixed, on the boundary, or where the mesh is not manifold.";
    return {"nothing can flow", {}, {boundary != Boundary::Fixed ? why : why + " A free boundary would flow."}};
}

void remark_on_drift(const FlowOptions& options, FlowReport& report)
{
    if (report.steps.empty() || report.steps.back().estimated_v_max.value_or(0.0) <= 1.0)
        return;
    const double distance = *report.steps.back().estimated_v_max;
    report.remarks.push_back(
        {"drift",
         {{"mean edge lengths", distance}},
         {fmt::format("The result is, by estimate, up to {:.2g} mean edge lengths away from the undecomposed flow: {}",
                      distance,
                      options.accuracy.tolerance
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

void remark_on_collapse(double extent_before, double extent_after, FlowReport& report)
{
    constexpr double next_to_nothing = 1e-3;
    if (extent_after >= next_to_nothing * extent_before)
        return;
    const double left = extent_after / extent_before;
    report.remarks.push_back(
        {"collapse",
         {{"extent", left}},
         {fmt::format("The surface has shrunk to {:.1g} of its extent: smaller or fewer steps leave more of it.",
                      left)}});
}

}  // namespace seamflow
