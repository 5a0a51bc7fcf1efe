#pragma once

#include "engine/steppers/stepper.h"

namespace seamflow {

/// The kind of steps for other data that follow: Further steps; or Again, the same steps as since the last data with
/// Further steps. Steps that are taken again are counted once.
enum class DataSteps { Further, Again };

/// A stepper that can take its steps with any data in place of positions, where it has one matrix for all steps:
/// (M + dt K) Xᵏ⁺¹ = M Xᵏ.
class HeatStepper : public Stepper {
  public:
    /// Continues from other data than positions: positions() are then the data. Estimates of errors are dropped.
    /// @param data #V by 3.
    virtual void set_data(const Points& data, DataSteps steps) = 0;
};

}  // namespace seamflow
