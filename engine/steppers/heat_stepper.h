#pragma once

#include "engine/steppers/stepper.h"

namespace seamflow {

/// How the steps that follow new data are counted. Further: as additional steps. Again: as repetitions, for other
/// columns of data, of the steps since the last data with Further; a repeated step is counted once.
enum class DataSteps { Further, Again };

/// A stepper that can take its steps with any data in place of positions, where it has one matrix for all steps:
/// (M + dt K) Xᵏ⁺¹ = M Xᵏ.
class HeatStepper : public Stepper {
  public:
    /// Continues from other data than positions: positions() are then the data. Guesses from earlier steps are dropped;
    /// the estimate of the error adds up over all data.
    /// @param data #V by 3.
    virtual void set_data(const Points& data, DataSteps steps) = 0;
};

}  // namespace seamflow
