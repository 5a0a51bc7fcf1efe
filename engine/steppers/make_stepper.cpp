#include "engine/steppers/make_stepper.h"

#include <utility>

#include "engine/steppers/conjugate_gradient_stepper.h"
#include "engine/steppers/explicit_stepper.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/steppers/switching_stepper.h"
#include "engine/steppers/undecomposed_stepper.h"

namespace seamflow {

namespace {

/// Makes the stepper for one of the ways.
struct StepperMaker {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Cut& cut;
    const StepSettings& settings;
    std::vector<double> curvature;
    Progress& progress;

    std::unique_ptr<Stepper> operator()(const SweepSteps& sweeps)
    {
        return std::make_unique<SweepStepper>(mesh, topology, cut, settings, sweeps, std::move(curvature), progress);
    }

    std::unique_ptr<Stepper> operator()(const ConvergedSteps& converged)
    {
        return std::make_unique<SchurStepper>(mesh, topology, cut, settings, converged.stop, progress);
    }

    std::unique_ptr<Stepper> operator()(const GradientSteps& gradients)
    {
        if (gradients.costs)
            return std::make_unique<SwitchingStepper>(mesh, topology, settings, gradients, progress);
        return std::make_unique<ConjugateGradientStepper>(mesh, topology, settings, gradients.stop, progress);
    }

    std::unique_ptr<Stepper> operator()(const UndecomposedSteps& undecomposed)
    {
        return make_undecomposed_stepper(mesh, topology, settings, undecomposed, progress);
    }

    std::unique_ptr<Stepper> operator()(const ExplicitSteps&)
    {
        return std::make_unique<ExplicitStepper>(mesh, topology, settings.equation, progress);
    }
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                      const WayOfSteps& way, const StepSettings& settings,
                                      std::vector<double> curvature, Progress& progress)
{
    return std::visit(StepperMaker{mesh, topology, cut, settings, std::move(curvature), progress}, way);
}

}  // namespace seamflow
