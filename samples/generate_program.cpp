// Generates a mesh for experiments.

#include <array>
#include <iostream>
#include <limits>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"
#include "samples/command/command_line.h"
#include "samples/files/output_files.h"
#include "samples/meshes/meshes.h"
#include "samples/programs.h"

namespace seamflow {

namespace {

std::string listed_kinds()
{
    std::string names;
    std::string text;
    for (const MeshKind& kind : mesh_kinds()) {
        if (!kind.name.ends_with("-quads"))
            names.append(names.empty() ? "" : " ").append(kind.name);
        text.append("\n").append(kind.name).append(": ").append(kind.description);
    }
    return names + "; also -quads" + text;
}

}  // namespace

ExitStatus run_generate_program(int argc, char** argv)
{
    CLI::App app("Makes a mesh to try things on.", "generate");
    std::string kind;
    std::filesystem::path output;
    Index vertices = 10'000;
    MeshVariation variation;
    const Limits any{.least = -1e6, .most = 1e6, .below_most = false};
    const Limits not_negative{.least = 0.0, .most = 1e6, .below_most = false};
    int seed = 1;
    app.add_option("KIND", kind, listed_kinds())->required()->type_name("");
    app.add_option("OUTPUT", output,
                   "the mesh: " + extensions_of() + ", optionally followed by .gz; - for OBJ on standard output")
        ->required()
        ->type_name("");
    add_integer(app, "--vertices", vertices, 100, "about so many vertices [10000]");
    auto* seed_option = add_integer(app, "--seed", seed, 0, "of everything drawn at random [1]");
    add_real(app, "--amplitude", variation.amplitude, any, "height of the waves [that of the kind]");
    add_real(app, "--noise", variation.noise, not_negative, "in mean vertex distances [that of the kind]");
    app.footer("generate triangles waves.ply --vertices 100000     a wavy height field of triangles\n"
               "generate gear gear.stl                             a part with sharp edges\n"
               "generate foam foam.ply                             sheets that meet, with the cells of each face\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return *end;
    if (seed_option->count() > 0)
        variation.seed = static_cast<std::uint32_t>(seed);
    const FileKind file_kind = kind_for_writing(output, FileKind{});
    require_writable(output);

    const LabelSurface surface = make_surface(kind, vertices, variation);
    const PolygonMesh& mesh = surface.mesh;
    Workers workers(0);
    if (surface.front.empty() || file_kind.format != FileFormat::Ply)
        write_mesh(output, mesh, file_kind, workers.exec());
    else
        write_numbered_ply(output, mesh, std::array<FaceNumbers, 2>{{{"front", surface.front}, {"back", surface.back}}},
                           workers.exec());
    std::ostream& out = is_standard_stream(output) ? std::cerr : std::cout;
    out << output.string() << ": " << mesh.n_vertices() << " vertices, " << mesh.n_faces() << " faces" << std::endl;
    return ExitStatus::Success;
}

}  // namespace seamflow
