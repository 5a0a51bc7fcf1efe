// Repeats every experiment of the paper, and reports which of its claims hold here.
//
//     mesh ──► cut in two by rows ──► flows, decomposed and not ──► table ──► claims
//     (the authors' own file,                          │             │         │
//     or one of the same kind)              FIGURE-….ply         FIGURE.csv  claims.csv ──► index.html
//                                                      └──► draw.py ◄──┘
//                                                               │
//                                                      FIGURE-….png, FIGURE-curves.svg

#include <iostream>

#include "engine/tasks/stopwatch.h"
#include "samples/figures/claims.h"
#include "samples/figures/drawing.h"
#include "samples/figures/experiments.h"
#include "samples/figures/figures_command.h"
#include "samples/figures/index_page.h"
#include "samples/figures/runner.h"
#include "samples/files/output_files.h"

using namespace seamflow;

namespace {

/// Runs one experiment, writes its table and meshes, and draws them.
FigureResult run_figure(const Experiment& experiment, const FiguresCommand& command, const Drawing& drawing)
{
    const std::string name(experiment.name);
    Places places{.meshes = command.meshes, .out = command.out};
    if (command.html)
        places.page = command.out / (name + ".html");
    FigureResult result{
        .experiment = &experiment, .table = run_experiment(experiment, places, std::cout), .claims = {}};
    write_csv(command.out / (name + ".csv"), {result.table});
    drawing.draw(name);
    for (const std::string& remark : result.table.remarks)
        std::cout << "  remark: " << remark << '\n';
    result.claims = claims_of(result.table);
    return result;
}

/// Writes and draws one table of all experiments with increasingly many sub-meshes, without meshes to look at.
std::vector<Claim> run_many(const FiguresCommand& command, const Drawing& drawing)
{
    std::vector<Table> tables;
    for (const Experiment& experiment : experiments())
        if (const Experiment many = with_many_sub_meshes(experiment); many.variants.back().cut == CutKind::Metis)
            tables.push_back(run_experiment(many, {.meshes = command.meshes, .out = {}}, std::cout));
    write_csv(command.out / (std::string(many_sub_meshes) + ".csv"), tables);
    drawing.draw(std::string(many_sub_meshes));
    return claims_of_many(tables);
}

/// The names of the wanted figures from one on, in order; empty if that one is not wanted.
std::string to_come(const FiguresCommand& command, std::string_view from)
{
    std::string names;
    const auto add = [&](std::string_view name) {
        if ((!names.empty() || name == from) && command.wants(name))
            names.append(names.empty() ? "" : ", ").append(name);
    };
    for (const Experiment& experiment : experiments())
        add(experiment.name);
    add(many_sub_meshes);
    return names;
}

ExitStatus figures(int argc, char** argv)
{
    FiguresCommand command;
    if (const auto end = parse_figures_command(argc, argv, command))
        return *end;
    const Stopwatch watch;
    const Drawing drawing(command.out);
    std::vector<FigureResult> results;
    std::vector<Claim> claims;
    std::vector<Claim> many;
    // Finished figures can be viewed while the rest are made.
    const auto write_index = [&](std::string_view begun) {
        write_claims(command.out / "claims.csv", claims);
        write_text(command.out / "index.html",
                   index_html(results, many, command.html, to_come(command, begun), drawing.remark_on_page()));
    };
    for (const Experiment& experiment : experiments())
        if (command.wants(experiment.name)) {
            write_index(experiment.name);
            results.push_back(run_figure(experiment, command, drawing));
            claims.insert(claims.end(), results.back().claims.begin(), results.back().claims.end());
        }
    if (command.wants(many_sub_meshes)) {
        write_index(many_sub_meshes);
        many = run_many(command, drawing);
        claims.insert(claims.end(), many.begin(), many.end());
    }
    write_index({});
    print_claims(std::cout, claims);
    if (const std::string remark = drawing.remark(); !remark.empty())
        std::cout << remark << '\n';
    std::cout << (command.out / "index.html").string() << " shows it all; done in " << watch.seconds() << " s"
              << std::endl;
    return ExitStatus::Success;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("figures", [&] { return figures(argc, argv); });
}
