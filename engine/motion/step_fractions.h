#pragma once

#include <algorithm>

namespace seamflow {

/// Where the phases of the steps begin and end within a whole run, as fractions. The whole ends with the expected
/// number of steps, however many follow. All steps are assumed to take equally long; a step is divided in the ratios of
/// the previous one.
class StepFractions {
  public:
    /// @param begin the fraction of the whole that is done before the first step.
    /// @param steps the expected number of steps. @param with_reference whether each step has a step of the
    /// undecomposed flow. The first step is divided by a guess: 0.3 for its tasks and 0.6 for the reference, or 0.9 for
    /// its tasks alone; the rest for measurements.
    StepFractions(double begin, int steps, bool with_reference)
        : begin_(begin)
        , length_((1.0 - begin) / steps)
        , tasks_(with_reference ? 0.3 : 0.9)
        , reference_(with_reference ? 0.6 : 0.0)
    {
    }

    /// Fractions of the whole: the beginning of the step, the end of its tasks, the beginning of its reference step,
    /// and the end of the step.
    [[nodiscard]] double begin() const { return std::min(begin_ + n_done_ * length_, 1.0); }
    [[nodiscard]] double end_of_tasks() const { return std::min(begin() + tasks_ * length_, 1.0); }
    [[nodiscard]] double begin_of_reference() const { return end() - reference_ * length_; }
    [[nodiscard]] double end() const { return std::min(begin_ + (n_done_ + 1) * length_, 1.0); }

    /// The number of the present step, from 1.
    [[nodiscard]] int number() const { return n_done_ + 1; }

    /// Records the times of a step and continues with the next step.
    void end_step(double task_seconds, double measuring_seconds, double reference_seconds)
    {
        ++n_done_;
        const double all = task_seconds + measuring_seconds + reference_seconds;
        if (!(all > 0.0))
            return;
        tasks_ = task_seconds / all;
        reference_ = reference_seconds / all;
    }

  private:
    double begin_;
    /// The fraction of the whole that one step takes.
    double length_;
    /// The fractions of a step that its tasks and its reference step take.
    double tasks_;
    double reference_;
    int n_done_ = 0;
};

}  // namespace seamflow
