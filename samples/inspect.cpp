// Reports the elements of a mesh and its defects, element by element.

#include <iostream>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_io.h"
#include "partition/inspection/mesh_inspection.h"
#include "samples/command/command_line.h"
#include "samples/files/mesh_results.h"
#include "samples/report/inspection_text.h"
#include "samples/report/report_json.h"

using namespace seamflow;

namespace {

/// @returns UnusableInput if `smooth` would not accept the file as it is.
ExitStatus inspect_file(int argc, char** argv)
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
    const MeshInspection found = inspect(mesh, make_topology(mesh, exec), exec);
    if (as_json)
        std::cout << inspection_json(input.string(), faults, found);
    else
        print_inspection(std::cout, input.string(), faults, found, most_listed);
    require_faces(input, mesh.n_faces(), faults);
    return faults.count == faults.n_harmless ? ExitStatus::Success : ExitStatus::UnusableInput;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("inspect", [&] { return inspect_file(argc, argv); });
}
