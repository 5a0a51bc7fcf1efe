#include "engine/steppers/undecomposed_stepper.h"

#include <vector>

#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "partition/cut/cut_into.h"

namespace seamflow {

std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, const UndecomposedSteps& way,
                                                   Progress& progress)
{
    const Cut whole = cut_into(mesh, topology, 1);
    // A SchurStepper keeps the factor of a linear flow, and measures residuals.
    if (settings.equation.is_linear() || way.tolerance)
        return std::make_unique<SchurStepper>(mesh, topology, whole, settings, way.stop(), progress);
    return std::make_unique<SweepStepper>(mesh, topology, whole, settings, SweepSteps(), std::vector<double>(),
                                          progress);
}

}  // namespace seamflow
