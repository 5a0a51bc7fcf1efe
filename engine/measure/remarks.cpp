#include "engine/measure/remarks.h"

#include <string>

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
    const bool depends_on_faces = traits_of(laplacian).reach == Reach::Edges;
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

void remark_on_collapse(double extent_before, double extent_after, RunReport& report)
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
