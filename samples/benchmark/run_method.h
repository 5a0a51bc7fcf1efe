#pragma once

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// Takes the steps of a task in this process. The caller measures the peak memory.
/// @throws ComputationError, OptionError, InputError as the method itself; a message of a failure becomes
///         MethodResult::error where it is caught.
MethodResult run_method(PolygonMesh mesh, const MethodTask& task);

}  // namespace seamflow
