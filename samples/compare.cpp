// Tells how far the vertices of one mesh are from those of another with the same faces.

#include <algorithm>
#include <iostream>

#include "partition/errors.h"
#include "partition/io/mesh_io.h"
#include "samples/common/command_line.h"
#include "samples/common/output_files.h"
#include "samples/common/report_json.h"
#include "samples/common/report_text.h"

using namespace seamflow;

namespace {

void require_same(const char* what, Index reference, Index candidate)
{
    if (reference != candidate)
        throw InputError("the meshes do not correspond: REFERENCE has " + std::to_string(reference) + " " + what +
                         ", CANDIDATE " + std::to_string(candidate));
}

void require_corresponding(const PolygonMesh& reference, const PolygonMesh& candidate)
{
    require_same("vertices", reference.n_vertices(), candidate.n_vertices());
    require_same("faces", reference.n_faces(), candidate.n_faces());
    for (Index f = 0; f < reference.n_faces(); ++f)
        if (!std::ranges::equal(reference.face(f), candidate.face(f)))
            throw InputError("the meshes do not correspond: face " + std::to_string(f) +
                             " (counted from 0) has different vertices, or the same in another order");
}

Comparison compare_files(const std::filesystem::path& reference_path, const std::filesystem::path& candidate_path)
{
    const PolygonMesh reference = read_mesh(reference_path).mesh;
    const PolygonMesh candidate = read_mesh(candidate_path).mesh;
    require_corresponding(reference, candidate);
    return {.reference = reference_path.string(),
            .candidate = candidate_path.string(),
            .vertices = reference.n_vertices(),
            .faces = reference.n_faces(),
            .distance = vertex_distance(reference, reference.vertices, candidate.vertices)};
}

ExitStatus compare(int argc, char** argv)
{
    CLI::App app("Distance of corresponding vertices of two meshes: mean, root mean square and largest.", "compare");
    std::filesystem::path reference;
    std::filesystem::path candidate;
    std::filesystem::path report;
    app.add_option("REFERENCE", reference, "mesh whose mean edge length is the unit")->required()->type_name("");
    app.add_option("CANDIDATE", candidate, "mesh with the same faces")->required()->type_name("");
    app.add_option("--report", report, "also write the distances as JSON")->type_name("REPORT.json");
    if (const auto end = parse_command_line(app, argc, argv))
        return *end;
    if (!report.empty()) {
        require_different({reference, report});
        require_different({candidate, report});
        require_writable(report);
    }

    const Comparison comparison = compare_files(reference, candidate);
    print_comparison(std::cout, comparison);
    if (!report.empty())
        write_text(report, compare_report_json(comparison));
    return ExitStatus::Success;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("compare", [&] { return compare(argc, argv); });
}
