#pragma once

#include <cstddef>
#include <memory>

#include "engine/distributed/ranks/transport.h"

namespace seamflow {

/// The ranks of MPI_COMM_WORLD. Starts MPI where that has not been done; then MPI ends with the transport. What
/// comes in between belongs into run_together, so that no rank ends alone. If a process dies, MPI ends the others.
/// @param largest_piece longer messages are sent in pieces of so many bytes, as MPI counts them in 31 bits.
/// @throws ComputationError where MPI does not let several threads take turns (MPI_THREAD_SERIALIZED).
std::unique_ptr<Transport> make_mpi_transport(std::size_t largest_piece = std::size_t{1} << 30);

}  // namespace seamflow
