#pragma once

#include <limits>
#include <string>
#include <vector>

#include "samples/options/all_options.h"
#include "tests/support/flows.h"

namespace seamflow::test {

/// A way of taking steps, with a name for the messages of tests.
struct FlowKind {
    std::string name;
    AllOptions options;

    /// Whether there are systems of sub-meshes, to be factorised in a task each.
    [[nodiscard]] bool factorises() const
    {
        return options.scheme == Scheme::BackwardEuler && options.accuracy.approach != Approach::ConjugateGradients &&
               options.accuracy.approach != Approach::Automatic;
    }
};

/// One of each kind that hands something of its own from step to step, for meshes of some hundred vertices: four steps
/// of two squared mean edge lengths.
/// @param edge mean edge length.
inline std::vector<FlowKind> flow_kinds(double edge)
{
    AllOptions sweeps;
    sweeps.time_step = 2.0 * edge * edge;
    sweeps.steps = 4;
    sweeps.cut.subdomains = 7;
    sweeps.accuracy.approach = Approach::Sweep;
    // Some are rough with so many sub-meshes.
    sweeps.accuracy.largest_update = std::numeric_limits<double>::infinity();
    std::vector<FlowKind> kinds;
    const auto add = [&](const std::string& name, auto change) {
        kinds.push_back({name, sweeps});
        change(kinds.back().options);
    };
    for (const Laplacian laplacian : all_laplacians) {
        const std::string of(name_of(laplacian));
        add(of + " by sweeps", [&](AllOptions& o) { o.laplacian = laplacian; });
        add(of + " converged", [&](AllOptions& o) { o.laplacian = laplacian, o.accuracy.tolerance = 1e-3; });
        add(of + " by Schwarz",
            [&](AllOptions& o) { o.laplacian = laplacian, o.interface.conditions = Conditions::Schwarz; });
    }
    for (const Laplacian laplacian : symmetric_laplacians)
        add(std::string(name_of(laplacian)) + " by conjugate gradients", [&](AllOptions& o) {
            o.laplacian = laplacian, o.cut.subdomains = 0, o.accuracy.approach = Approach::ConjugateGradients;
        });
    add("attached, by conjugate gradients", [&](AllOptions& o) {
        o.motion.attachment = 0.1 / (edge * edge);
        o.cut.subdomains = 0, o.accuracy.approach = Approach::ConjugateGradients;
    });
    for (const bool is_converged : {false, true}) {
        const auto add_further = [&](const std::string& name, auto change) {
            add(name + (is_converged ? ", converged" : ", by sweeps"), [&](AllOptions& o) {
                change(o);
                if (is_converged)
                    o.accuracy.tolerance = 1e-3;
            });
        };
        add_further("conformalized", [](AllOptions& o) {
            o.laplacian = Laplacian::VirtualRefinement, o.flow = FlowEquation::Conformalized;
        });
        add_further("low-pass", [](AllOptions& o) { o.filter = Filter::LowPass; });
        add_further("k-harmonic", [](AllOptions& o) { o.laplacian = Laplacian::Uniform, o.order = 3; });
        add_further("low-pass of order 4, attached", [&](AllOptions& o) {
            o.filter = Filter::LowPass, o.order = 4, o.motion.attachment = 0.1 / (edge * edge);
        });
        add_further("attached", [&](AllOptions& o) {
            o.laplacian = Laplacian::AlexaWardetzky, o.motion.attachment = 0.1 / (edge * edge);
        });
    }
    add("few iterations", [](AllOptions& o) { o.accuracy.tolerance = 1e-9, o.accuracy.converge_iterations = 2; });
    // With so short a step the same is chosen for any number of steps.
    add("chosen",
        [](AllOptions& o) { o.cut.subdomains = 0, o.accuracy.approach = Approach::Automatic, o.time_step *= 0.05; });
    add("undecomposed", [](AllOptions& o) { o.cut.subdomains = 0, o.accuracy.approach = Approach::Undecomposed; });
    add("rescaled", [](AllOptions& o) {
        o.accuracy.tolerance = 1e-2, o.motion.boundary = Boundary::Free, o.motion.rescale = Rescale::Area;
    });
    add("rescaled and conformalized", [](AllOptions& o) {
        o.flow = FlowEquation::Conformalized, o.accuracy.tolerance = 1e-3, o.report.reference = true;
        o.motion.boundary = Boundary::Free, o.motion.rescale = Rescale::Area;
    });
    add("linear", [](AllOptions& o) { o.flow = FlowEquation::Linear, o.accuracy.tolerance = 1e-3; });
    // Single precision goes no further.
    add("linear, tight", [](AllOptions& o) { o.flow = FlowEquation::Linear, o.accuracy.tolerance = 1e-14; });
    add("linear, with reference",
        [](AllOptions& o) { o.flow = FlowEquation::Linear, o.accuracy.tolerance = 1e-9, o.report.reference = true; });
    add("linear, undecomposed", [](AllOptions& o) {
        o.flow = FlowEquation::Linear, o.cut.subdomains = 0, o.accuracy.approach = Approach::Undecomposed;
    });
    add("bounded", [&](AllOptions& o) { o.motion.within = 0.2 * edge; });
    add("limited", [&](AllOptions& o) { o.motion.limits = {.volume = 0.01, .move = 0.2 * edge}; });
    add("held", [](AllOptions& o) { o.motion.fixed_vertices = {3, 100, 101, 102, 250}; });
    add("edges kept",
        [](AllOptions& o) { o.keep_edges = 40.0, o.cut.subdomains = 0, o.accuracy.approach = Approach::Automatic; });
    add("uncut", [](AllOptions& o) { o.cut.subdomains = 1; });
    add("plain",
        [](AllOptions& o) { o = FlowOptions::plain(), o.steps = 4, o.cut.subdomains = 7, o.time_step = 1e-3; });
    add("uncorrected", [](AllOptions& o) { o.interface.correction = Correction::None; });
    add("adapted ventcell",
        [](AllOptions& o) { o.interface.conditions = Conditions::AdaptedVentcell, o.interface.q = 0.1; });
    add("robin with gaps",
        [](AllOptions& o) { o.interface.conditions = Conditions::Robin, o.report.keep_gaps = true; });
    add("ventcell", [](AllOptions& o) { o.interface.conditions = Conditions::Ventcell, o.interface.q = 0.1; });
    add("reference", [](AllOptions& o) { o.report.reference = true; });
    add("converged with reference", [](AllOptions& o) { o.report.reference = true, o.accuracy.tolerance = 1e-2; });
    add("explicit", [&](AllOptions& o) { o.scheme = Scheme::ExplicitEuler, o.time_step = 1e-4 * edge * edge; });
    return kinds;
}

}  // namespace seamflow::test
