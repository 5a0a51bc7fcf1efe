#pragma once

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// Takes the steps of a task by conjugate gradients on the equations of the whole mesh, written for this one job: three
/// columns at once, Jacobi, all threads, matrix and vectors in single precision. If single precision cannot reach the
/// tolerance, the residual is recomputed in double precision. Shares no code with Approach::ConjugateGradients, for
/// which it is the yardstick. For symmetric Laplacians.
/// @throws ComputationError if the tolerance is not reached.
MethodResult run_fused_cg(const PolygonMesh& mesh, const MethodTask& task);

}  // namespace seamflow
