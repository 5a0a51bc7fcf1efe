#pragma once

#include "engine/distributed/ranks/communicator.h"
#include "partition/index.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// Joins what ranks have noted, each in a slice of a file: the slices follow each other. All ranks call this together.
/// @param own of this rank, with faces numbered from 0 in its slice. @param n_faces of its slice, those included that
/// are left out.
/// @returns at rank 0 what a reader of the whole file notes; elsewhere nothing.
FaultLog join_faults(Communicator& comm, const FaultLog& own, Index n_faces);

}  // namespace seamflow
