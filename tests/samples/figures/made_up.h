#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

#include "samples/figures/experiments.h"
#include "samples/figures/runner.h"

/// Experiments and tables of the tests of figures.
namespace seamflow::test {

inline constexpr Laplacian fujiwara = Laplacian::Fujiwara;
inline constexpr Laplacian alexa = Laplacian::AlexaWardetzky;
inline constexpr Laplacian velho = Laplacian::PtackovaVelho;

/// An experiment on a mesh small enough for a test.
inline Experiment small(std::string_view name, Index vertices = 500)
{
    const auto& all = experiments();
    Experiment experiment =
        *std::find_if(all.begin(), all.end(), [&](const Experiment& one) { return one.name == name; });
    experiment.source.vertices = vertices;
    return experiment;
}

inline Table run(const Experiment& experiment, const Places& places = {})
{
    std::ostringstream log;
    return run_experiment(experiment, places, log);
}

/// A row of a table that somebody made up.
inline Row row(Laplacian laplacian, const std::string& conditions, double v_mean)
{
    Row made;
    made.laplacian = laplacian;
    made.conditions = conditions;
    made.step = 5;
    made.v.mean = v_mean;
    return made;
}

inline Table wavy_table(double schwarz, double robin)
{
    Table table;
    table.figure = "wavy-cylinder";
    table.steps = 5;
    table.rows = {row(fujiwara, "schwarz", schwarz), row(fujiwara, "adapted-robin", robin),
                  row(velho, "schwarz", schwarz), row(velho, "adapted-robin", robin)};
    return table;
}

}  // namespace seamflow::test
