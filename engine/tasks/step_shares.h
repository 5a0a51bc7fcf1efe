#pragma once

namespace seamflow {

/// Where in a whole flow the parts of its steps begin and end. All steps are as long as each other; what happens in one
/// is divided as the time of the step before was.
class StepShares {
  public:
    /// @param begin the fraction of the whole that is done before the first step.
    /// @param steps how many there are.
    StepShares(double begin, int steps, bool with_reference)
        : begin_(begin)
        , length_((1.0 - begin) / steps)
        , tasks_(with_reference ? 0.3 : 0.9)
        , reference_(with_reference ? 0.6 : 0.0)
    {
    }

    /// Fractions of the whole: the beginning of the step, the end of its tasks, the beginning of its reference step,
    /// and its end.
    [[nodiscard]] double begin() const { return begin_ + n_done_ * length_; }
    [[nodiscard]] double end_of_tasks() const { return begin() + tasks_ * length_; }
    [[nodiscard]] double begin_of_reference() const { return end() - reference_ * length_; }
    [[nodiscard]] double end() const { return begin_ + (n_done_ + 1) * length_; }

    /// Goes on to the next step.
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
    double length_;
    double tasks_;
    double reference_;
    int n_done_ = 0;
};

}  // namespace seamflow
