#include "samples/command/compare_command.h"

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"
#include "samples/command/command_line.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

void add_options(CLI::App& app, CompareCommand& command)
{
    app.add_option("REFERENCE", command.reference, "mesh whose mean edge length is the unit")
        ->required()
        ->type_name("");
    app.add_option("CANDIDATE", command.candidate, "mesh to measure; for V_, with the same vertices and faces")
        ->required()
        ->type_name("");
    std::vector<std::pair<std::string, Direction>> directions;
    for (const Direction direction :
         {Direction::ReferenceToCandidate, Direction::CandidateToReference, Direction::Both, Direction::Symmetric})
        directions.emplace_back(name_of(direction), direction);
    add_choice<Direction>(app, "--direction", command.direction, directions,
                          "which way H_ is measured [the first]\n"
                          "From whose vertices to whose surface; symmetric: the larger of both.");
    app.add_option("--report", command.report, "also write the numbers as JSON; - for standard output")
        ->type_name("REPORT.json");
    auto* error_map =
        app.add_option("--error-map", command.error_map, "write the candidate with a colour and a value per vertex")
            ->type_name("FILE.ply");
    add_choice<Shown>(app, "--show", command.shown,
                      {{"surface-distance", Shown::SurfaceDistance},
                       {"vertex-distance", Shown::VertexDistance},
                       {"tangential", Shown::Tangential},
                       {"normal", Shown::Normal}},
                      "what the error map shows [surface-distance]")
        ->needs(error_map);
    add_real(app, "--full-scale", command.full_scale, positive(),
             "length that gets the last colour of the error map [the largest]")
        ->needs(error_map);
}

void require_usable_files(const CompareCommand& command)
{
    if (!command.error_map.empty() && kind_for_writing(command.error_map, FileKind{}).format != FileFormat::Ply)
        throw OptionError("--error-map " + command.error_map.string() + ": error maps are written as .ply only");
    std::vector<std::filesystem::path> results;
    if (!command.error_map.empty())
        results.push_back(command.error_map);
    require_files(results);
    if (!command.report.empty() && !is_standard_stream(command.report))
        results.push_back(command.report);
    for (const auto& input : {command.reference, command.candidate}) {
        std::vector<std::filesystem::path> files = results;
        files.push_back(input);
        require_different(files);
    }
    for (const auto& path : results)
        require_writable(path);
}

}  // namespace

std::optional<ExitStatus> parse_compare_command(int argc, char** argv, CompareCommand& command)
{
    CLI::App app("Distances of two meshes: of corresponding vertices (V_), and of vertices from the surface (H_); "
                 "mean, root mean square and largest.",
                 "compare");
    add_options(app, command);
    app.footer("compare scan.ply smooth.ply                      how far vertices and surfaces are apart\n"
               "compare truth.obj smooth.obj --direction both     from each surface to the other\n"
               "compare scan.ply smooth.ply --error-map map.ply   where they are, in colours\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return end;
    require_usable_files(command);
    return std::nullopt;
}

}  // namespace seamflow
