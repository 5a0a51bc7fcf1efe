#pragma once

#include "engine/distributed/ranks/communicator.h"
#include "partition/index.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// Joins the faults that ranks noted, each in a slice of a file: slices are consecutive. All ranks call this together.
/// @param own of this rank, with faces numbered from 0 in its slice. @param n_faces of its slice, including those left
/// out.
/// @returns at rank 0 what a reader of the whole file notes; empty elsewhere.
FaultLog join_faults(Communicator& comm, const FaultLog& own, Index n_faces);

}  // namespace seamflow
