// Reports how far one mesh is from another: vertex to vertex, and vertex to surface.

#include <iostream>

#include "engine/tasks/workers.h"
#include "partition/io/input_file.h"
#include "samples/command/compare_command.h"
#include "samples/files/mesh_input.h"
#include "samples/files/output_files.h"
#include "samples/programs.h"
#include "samples/report/report_json.h"
#include "samples/report/report_text.h"

namespace seamflow {

ExitStatus run_compare_program(int argc, char** argv)
{
    CompareCommand command;
    if (const auto end = parse_compare_command(argc, argv, command))
        return *end;
    Workers workers(0);
    const auto read = [&](const std::filesystem::path& path) {
        FaultLog left_out{.of_faces_alone = true};
        return read_surface(path, &left_out, workers.exec()).mesh;
    };
    const PolygonMesh reference = read(command.reference);
    const PolygonMesh candidate = read(command.candidate);

    Comparison comparison = compare_meshes(reference, candidate, command.direction, workers.exec());
    comparison.reference = command.reference.string();
    comparison.candidate = command.candidate.string();
    std::ostream& out = is_standard_stream(command.report) ? std::cerr : std::cout;
    print_comparison(out, comparison);
    if (!command.report.empty())
        write_text(command.report, compare_report_json(comparison));
    if (!command.error_map.empty()) {
        const ErrorRange range =
            write_error_map(command.error_map, reference, candidate, command.shown, command.full_scale);
        print_error_map(out, command.error_map.string(), range);
    }
    return ExitStatus::Success;
}

}  // namespace seamflow
