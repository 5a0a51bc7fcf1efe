#include "engine/steppers/make_stepper.h"

#include <utility>

#include "engine/steppers/conjugate_gradient_stepper.h"
#include "engine/steppers/explicit_stepper.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "partition/cut/cut_into.h"

namespace seamflow {

std::unique_ptr<Stepper> make_stepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                      const FlowOptions& options, std::vector<double> curvature, Progress& progress)
{
    if (options.scheme == Scheme::ExplicitEuler)
        return std::make_unique<ExplicitStepper>(mesh, topology, options, progress);
    if (options.accuracy.approach == Approach::ConjugateGradients)
        return std::make_unique<ConjugateGradientStepper>(mesh, topology, options, progress);
    if (options.accuracy.tolerance || options.flow == FlowEquation::Linear)
        return std::make_unique<SchurStepper>(mesh, topology, cut, options, progress);
    return std::make_unique<SweepStepper>(mesh, topology, cut, options, std::move(curvature), progress);
}

std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const FlowOptions& options, std::optional<std::size_t> memory_limit,
                                                   Progress& progress)
{
    FlowOptions undecomposed = options;
    undecomposed.accuracy.approach = Approach::Undecomposed;
    undecomposed.accuracy.tolerance.reset();
    undecomposed.resources.memory_limit = memory_limit;
    const Cut whole = cut_into(mesh, topology, 1);
    if (options.flow == FlowEquation::Linear)
        return std::make_unique<SchurStepper>(mesh, topology, whole, undecomposed, progress);
    return std::make_unique<SweepStepper>(mesh, topology, whole, undecomposed, std::vector<double>(), progress);
}

}  // namespace seamflow
