#pragma once

#include "partition/library_lock.h"

namespace seamflow {

/// To be held while a library calls BLAS. OpenBLAS needs a work area (128 MiB) for each call at a time, and where the
/// address space is limited (ulimit -v) and full it asks for one again and again, for ever. So there one caller at a
/// time may go on, and the first one only if there is room. Without a limit nobody waits.
class BlasTurn {
  public:
    /// @throws std::bad_alloc if there is no room.
    BlasTurn();

  private:
    LibraryLock turn_;
};

}  // namespace seamflow
