#pragma once

#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/steppers/vanishing_components.h"

namespace seamflow {

/// Finds small components among the faces of all ranks, also those with faces on several ranks.
/// @param comm, mesh must outlive it.
FindSmallComponents find_small_components(Communicator& comm, const RankMesh& mesh);

}  // namespace seamflow
