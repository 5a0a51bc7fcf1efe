#pragma once

namespace seamflow {

/// To be held while a library calls BLAS. OpenBLAS needs a work area (128 MiB) for each call at a time, and where the
/// address space is limited (ulimit -v) and full it asks for one again and again, for ever. So where there is a limit,
/// callers wait until there is plenty of room for one more, or none is left; the first one goes on only if its area
/// fits. Without a limit nobody waits.
class BlasTurn {
  public:
    /// @throws ComputationError if there is no room.
    BlasTurn();
    ~BlasTurn();
    BlasTurn(const BlasTurn&) = delete;
    BlasTurn& operator=(const BlasTurn&) = delete;

  private:
    bool is_counted_ = false;
};

}  // namespace seamflow
