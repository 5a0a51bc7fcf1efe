#pragma once

namespace seamflow {

/// Whether an iteration no longer makes its residual smaller: when several measurements of it one after the other have
/// found too little progress. One of them alone may be on a plateau that ends.
class Stagnation {
  public:
    /// So many of them.
    static constexpr int most_stalls = 3;

    /// @param most_left the part of the residual before that may be left without it being too little progress.
    explicit Stagnation(double most_left)
        : most_left_(most_left)
    {
    }

    /// Takes note of a measurement.
    /// @param left the part of the residual before that is left; not a number: no progress.
    void note(double left) { stalls_ = left <= most_left_ ? 0 : stalls_ + 1; }

    /// Whether the last measurement has found too little progress.
    [[nodiscard]] bool is_stalling() const { return stalls_ > 0; }

    [[nodiscard]] bool is_reached() const { return stalls_ >= most_stalls; }

  private:
    double most_left_;
    int stalls_ = 0;
};

}  // namespace seamflow
