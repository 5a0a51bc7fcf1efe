#pragma once

namespace seamflow {

/// The conditions that end an iteration.
struct IterationStop {
    /// The residual to reach, in the unit in which the iteration measures residuals.
    double tolerance = 0.0;
    /// The most iterations.
    int iterations = 0;
};

/// How an iteration ended.
struct IterationResult {
    int iterations = 0;
    /// The residual as last measured, in the unit of the tolerance.
    double residual = 0.0;
    /// Whether the iteration ended above the tolerance, with iterations left, because they no longer reduced the
    /// residual.
    bool stagnated = false;
};

/// The stopping criterion of all iterations: the residual, measured now and then, is small enough; or there are no
/// iterations left; or the iteration stagnates: several consecutive measurements have found too little progress. A
/// single such measurement may be on a plateau that ends.
class StoppingCriterion {
  public:
    /// The number of consecutive measurements without enough progress that ends an iteration.
    static constexpr int most_stalls = 3;

    /// @param most_left the largest fraction of the previous residual that counts as enough progress.
    /// @param residual at the beginning.
    StoppingCriterion(const IterationStop& stop, double most_left, double residual)
        : stop_(stop)
        , most_left_(most_left)
        , residual_(residual)
    {
    }

    /// Records a measurement.
    /// @param iterations since the previous one.
    /// @param left the fraction of the previous residual left; not a number: no progress.
    void note(int iterations, double residual, double left)
    {
        iterations_ += iterations;
        residual_ = residual;
        stalls_ = left <= most_left_ ? 0 : stalls_ + 1;
    }

    /// Whether the iteration is to end; also if the residual is not a number.
    [[nodiscard]] bool is_met() const
    {
        return iterations_left() <= 0 || !(residual_ > stop_.tolerance) || stalls_ >= most_stalls;
    }

    /// Whether the last measurement has found too little progress.
    [[nodiscard]] bool is_stalling() const { return stalls_ > 0; }

    [[nodiscard]] int iterations_left() const { return stop_.iterations - iterations_; }

    /// @param residual as measured last.
    [[nodiscard]] IterationResult result(double residual) const
    {
        // The iterations since the last measurement may have been too few for progress if none are left.
        const bool stagnated = stalls_ >= most_stalls && residual > stop_.tolerance && iterations_left() > 0;
        return {.iterations = iterations_, .residual = residual, .stagnated = stagnated};
    }

  private:
    IterationStop stop_;
    double most_left_;
    double residual_;
    int iterations_ = 0;
    int stalls_ = 0;
};

}  // namespace seamflow
