#include "engine/steppers/undecomposed_stepper.h"

#include <vector>

#include "engine/setup/way_of_steps.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "partition/cut/cut_into.h"

namespace seamflow {

std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, Progress& progress,
                                                   bool reports_residual)
{
    const Cut whole = cut_into(mesh, topology, 1);
    // A SchurStepper keeps the factor of a linear flow, and measures residuals.
    if (settings.equation.is_linear() || reports_residual)
        return std::make_unique<SchurStepper>(mesh, topology, whole, settings, stop_without_interface, progress);
    return std::make_unique<SweepStepper>(mesh, topology, whole, settings, SweepSteps(), std::vector<double>(),
                                          progress);
}

}  // namespace seamflow
