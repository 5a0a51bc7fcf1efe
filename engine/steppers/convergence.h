#pragma once

#include <optional>
#include <string_view>

#include "engine/options/flow_report.h"
#include "engine/state/flow_state.h"

namespace seamflow {

/// What the iterations of one converged step have reached.
struct ConvergedStep {
    int iterations = 0;
    /// Relative to that of the positions before the step.
    double residual = 0.0;
    /// Estimated, of the positions to those of the undecomposed step, in units of length.
    double distance = 0.0;
    /// Whether more iterations would not have helped.
    bool stagnated = false;
};

/// How well the converged steps of a flow have kept to their tolerance.
class Convergence {
  public:
    /// @param tolerance of the residual.
    /// @param most_iterations of a step.
    Convergence(double tolerance, int most_iterations)
        : tolerance_(tolerance)
        , most_iterations_(most_iterations)
    {
    }

    [[nodiscard]] double tolerance() const { return tolerance_; }
    [[nodiscard]] int most_iterations() const { return most_iterations_; }

    void add(const ConvergedStep& step);

    /// Adds what the next step needs, and takes it back.
    /// @throws InputError if it does not fit.
    void save(StepMemory& memory) const;
    void restore(StepMemoryReader& memory);

    void describe(StepReport& report) const;

    /// @param advice what to do where steps missed the tolerance for want of iterations; may be empty.
    void describe(FlowReport& report, std::string_view advice) const;

  private:
    double tolerance_;
    int most_iterations_;
    ConvergedStep last_;
    /// Estimated distance of the positions to those of the undecomposed flow. The residuals of the steps are added up
    /// like independent errors.
    double distance_ = 0.0;
    int n_short_of_tolerance_ = 0;
    int n_stagnated_ = 0;
};

}  // namespace seamflow
