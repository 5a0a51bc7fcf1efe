// Trains the networks of the denoiser anew.
//
//     solids ──► patterns ──► surfaces ──► noise ──► stage 1 ──► … ──► stage 3 ──► the noise ──► mixing_weights.cpp
//                                                 (estimates, samples, a network)

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/tasks/workers.h"
#include "samples/command/command_line.h"
#include "samples/files/output_files.h"
#include "samples/training/denoiser_training.h"
#include "samples/training/surfaces.h"
#include "samples/training/weights_file.h"
#include "solvers/denoising/mixing_weights.h"

using namespace seamflow;

namespace {

std::vector<PolygonMesh> make_surfaces(std::uint32_t seed, int n, const Executor& exec)
{
    std::vector<std::optional<PolygonMesh>> made(usize(n));
    for_each(exec, n, [&](Index i) { made[i] = make_training_surface(seed, i); });
    std::vector<PolygonMesh> surfaces;
    for (std::optional<PolygonMesh>& surface : made)
        if (surface)
            surfaces.push_back(std::move(*surface));
    if (surfaces.empty())
        throw ComputationError("no surface could be made");
    return surfaces;
}

ExitStatus train(int argc, char** argv)
{
    CLI::App app("Trains the networks of the denoiser anew.", "train_denoiser");
    std::filesystem::path file;
    int n_surfaces = 2'700;
    int seed = 1;
    DenoiserTraining training;
    app.add_option("FILE", file, "the file to write: solvers/denoising/mixing_weights.txt, or another")
        ->required()
        ->type_name("");
    add_integer(app, "--surfaces", n_surfaces, 1, "how many to try to make [2700]");
    add_integer(app, "--samples", training.samples_per_surface, 1, "faces of each surface for each stage [800]");
    add_integer(app, "--epochs", training.epochs, 1, "how often a stage sees each of them [9]");
    add_integer(app, "--seed", seed, 0, "of everything drawn at random [1]");
    app.footer("train_denoiser solvers/denoising/mixing_weights.txt     an hour\n"
               "train_denoiser trial.txt --surfaces 30 --epochs 1       a trial: half a minute\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return *end;
    training.seed = static_cast<std::uint32_t>(seed);
    training.n_stages = static_cast<int>(mixing_weights().size());
    require_replaceable(file);
    require_writable(file);

    Workers workers(0);
    std::vector<PolygonMesh> surfaces = make_surfaces(training.seed, n_surfaces, workers.exec());
    std::cout << surfaces.size() << " surfaces" << std::endl;
    const TrainedDenoiser trained = train_denoiser(std::move(surfaces), training, std::cout, workers.exec());
    write_text(file, text_of_weights(trained));
    return ExitStatus::Success;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("train_denoiser", [&] { return train(argc, argv); });
}
