// Reports the elements of a mesh and its defects, element by element.

#include <iostream>
#include <optional>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_io.h"
#include "partition/inspection/mesh_inspection.h"
#include "samples/command/command_line.h"
#include "samples/files/mesh_input.h"
#include "samples/programs.h"
#include "samples/report/inspection_text.h"
#include "samples/report/report_json.h"
#include "samples/report/surface_roughness.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "solvers/rounding/rounded_surface.h"

namespace seamflow {

namespace {

/// What `smooth` finds on a surface without an amount: steps of its coordinates, or noise.
SurfaceRoughness roughness_of(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    Topology moving = topology;
    free_junctions(mesh, moving, exec);
    free_boundary(moving);
    if (const auto rounded = smooth_rounded(mesh, moving, mesh.vertices, {}, exec))
        return {.noise = {}, .steps = rounded->steps};
    return {.noise = measure_noise(mesh, topology, exec), .steps = {}};
}

}  // namespace

ExitStatus run_inspect_program(int argc, char** argv)
{
    CLI::App app("Tells what a mesh is made of and what is wrong with it. All numbers count from 0.", "inspect");
    std::filesystem::path input;
    bool as_json = false;
    int most_listed = 10;
    app.add_option("INPUT", input, "mesh: " + extensions_of() + ", optionally followed by .gz; - for standard input")
        ->required()
        ->type_name("");
    app.add_flag("--json", as_json, "write everything as JSON, with all elements");
    add_integer(app, "--list", most_listed, 0, "how many elements of each kind are named without --json [10]");
    app.footer("inspect scan.ply                    what it is made of and what is wrong with it\n"
               "inspect scan.ply --list 1000        with the numbers of up to 1000 elements of each kind\n"
               "inspect scan.ply --json > found.json   for other programs, with all elements\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return *end;

    FaultLog faults;
    Workers workers(0);
    const Executor exec = workers.exec();
    const PolygonMesh mesh = read_faulty_mesh(input, faults, exec).mesh;
    const Topology topology = make_topology(mesh, exec);
    const MeshInspection found = inspect(mesh, topology, exec);
    SurfaceRoughness roughness;
    // Where cracks are open, the faces as they are say nothing of the noise.
    if (mesh.n_faces() > 0 && found.defects.vertices_not_finite.empty() && !found.cracks)
        workers.execute([&] {
            if (found.defects.duplicate_faces.empty()) {
                roughness = roughness_of(mesh, topology, exec);
            } else {
                const PolygonMesh single = with_single_faces(mesh, found);
                roughness = roughness_of(single, make_topology(single, exec), exec);
            }
        });
    if (as_json)
        std::cout << inspection_json(input.string(), faults, found, roughness);
    else
        print_inspection(std::cout, input.string(), faults, found, most_listed, roughness);
    require_faces(input, mesh.n_faces(), faults);
    return faults.count == faults.n_harmless ? ExitStatus::Success : ExitStatus::UnusableInput;
}

}  // namespace seamflow
