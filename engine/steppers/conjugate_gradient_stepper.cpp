#include "engine/steppers/conjugate_gradient_stepper.h"

namespace seamflow {

ConjugateGradientStepper::ConjugateGradientStepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, const IterationStop& stop,
                                                   Progress& progress, const GivenStiffness* given)
    : ConvergedStepper(mesh, 0, settings, stop, 1.0, progress)
    , mesh_(&mesh)
    , system_(mesh, topology, settings.equation.laplacian, settings.equation.terms, progress.exec(),
              !settings.equation.filter.is_plain())
{
    if (given != nullptr)
        system_.give(*given);
}

InterfaceResult ConjugateGradientStepper::solve_equation(const IterationStop& stop, const Executor& exec)
{
    const WholeMeshSystem::Result result = data_ != nullptr
                                               ? system_.apply(*data_, stop, positions_, exec)
                                               : system_.step(*before_, time_step_, stop, positions_, exec, guess_);
    return {result, result.distance};
}

void ConjugateGradientStepper::report_to(FlowReport& report) const
{
    if (mesh_->n_faces() > 0)
        report.cut.sub_meshes = {{mesh_->n_faces(), mesh_->n_vertices()}};
    describe_steps(report);
}

}  // namespace seamflow
