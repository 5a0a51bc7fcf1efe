#pragma once

#include "engine/distributed/rank_report.h"
#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/stepper.h"

/// Data passed from step to step, in the ranges of all ranks. All ranks call these together.
namespace seamflow {

/// Adds to a state what the next step needs beside positions.
/// @param state has the vertices of this rank's range.
void collect_memory(Communicator& comm, const RankMesh& mesh, const Stepper& stepper, RankFlowState& state);

/// Gives all of it to a stepper that has not taken a step.
/// @throws the same InputError on all ranks if it does not fit.
void restore_memory(Communicator& comm, const RankMesh& mesh, const RankFlowState& state, Stepper& stepper);

}  // namespace seamflow
