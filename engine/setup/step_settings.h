#pragma once

#include <cstddef>
#include <optional>

#include "solvers/direct/factorisation.h"
#include "solvers/filters/step_filter.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The equation of every step, (M + dt K) Vᵏ⁺¹ = M Vᵏ, whatever the way in which it is solved.
struct StepEquation {
    /// The Laplacian of M and K.
    ScaledLaplacian laplacian = Laplacian::Fujiwara;
    StepFilter filter;
    /// dt, in length².
    double time_step = 0.0;
    /// The further terms. They refer to data of the flow's options, and to V⁰.
    FlowTerms terms;

    /// Whether all steps have one matrix: those of a linear flow.
    [[nodiscard]] bool is_linear() const { return terms.keeps_mass; }
};

/// The factorisations of a stepper; see ResourceOptions.
struct FactorSettings {
    Factorisation factorisation = Factorisation::Automatic;
    Precision precision = Precision::Automatic;
    /// The largest number of bytes of all factors at once; nullopt: the stepper decides.
    std::optional<std::size_t> memory_limit;
};

/// The settings that all ways of taking steps share.
struct StepSettings {
    StepEquation equation;
    FactorSettings factors;
    /// Whether the times of all tasks are recorded (see ReportOptions::record_schedule).
    bool records_schedule = false;
};

}  // namespace seamflow
