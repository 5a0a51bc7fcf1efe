#pragma once

#include <cstddef>
#include <memory>

#include "engine/ranks/transport.h"

namespace seamflow {

/// The ranks of MPI_COMM_WORLD. Starts MPI if that has not been done; MPI then ends with the transport. Work with the
/// transport belongs to a RankGroup and serve_flows, so that no rank ends alone. If a process dies, MPI ends the
/// others.
/// @param largest_piece longer messages are sent in pieces of this size, as MPI counts bytes in 31 bits.
/// @throws ComputationError if MPI does not let several threads take turns (MPI_THREAD_SERIALIZED).
std::unique_ptr<Transport> make_mpi_transport(std::size_t largest_piece = std::size_t{1} << 30);

}  // namespace seamflow
