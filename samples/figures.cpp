// Repeats every experiment of the paper, and tells which of its claims hold here.
//
//     mesh ──► cut in two by rows ──► flows, decomposed and not ──► table ──► claims
//     (the authors' own file,                                        │         │
//     or one of the same kind)                                   FIGURE.csv  claims.csv

#include <iostream>

#include "engine/stopwatch.h"
#include "samples/figures/claims.h"
#include "samples/figures/figures_command.h"
#include "samples/figures/runner.h"

using namespace seamflow;

namespace {

/// Writes the table of one experiment, and adds its claims.
void run_figure(const Experiment& experiment, const FiguresCommand& command, std::vector<Claim>& claims)
{
    Places places{.meshes = command.meshes, .pictures = command.out, .page = {}};
    if (command.html)
        places.page = command.out / (std::string(experiment.name) + ".html");
    const Table table = run_experiment(experiment, places, std::cout);
    write_csv(command.out / (table.figure + ".csv"), {table});
    for (const std::string& remark : table.remarks)
        std::cout << "  remark: " << remark << '\n';
    const std::vector<Claim> found = claims_of(table);
    claims.insert(claims.end(), found.begin(), found.end());
}

/// Writes one table of all experiments with more and more sub-meshes, without meshes to look at.
void run_many(const FiguresCommand& command, std::vector<Claim>& claims)
{
    std::vector<Table> tables;
    for (const Experiment& experiment : experiments())
        if (const Experiment many = with_many_sub_meshes(experiment); many.variants.back().pieces == Pieces::Metis)
            tables.push_back(run_experiment(many, {command.meshes, {}, {}}, std::cout));
    write_csv(command.out / (std::string(many_sub_meshes) + ".csv"), tables);
    const std::vector<Claim> found = claims_of_many(tables);
    claims.insert(claims.end(), found.begin(), found.end());
}

ExitStatus figures(int argc, char** argv)
{
    FiguresCommand command;
    if (const auto end = parse_figures_command(argc, argv, command))
        return *end;
    const Stopwatch watch;
    std::vector<Claim> claims;
    for (const Experiment& experiment : experiments())
        if (command.wants(experiment.name))
            run_figure(experiment, command, claims);
    if (command.wants(many_sub_meshes))
        run_many(command, claims);
    write_claims(command.out / "claims.csv", claims);
    print_claims(std::cout, claims);
    std::cout << command.out.string() << ": done in " << watch.seconds() << " s" << std::endl;
    return ExitStatus::Success;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("figures", [&] { return figures(argc, argv); });
}
