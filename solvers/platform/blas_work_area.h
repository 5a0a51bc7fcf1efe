#pragma once

namespace seamflow {

/// Must be held while a library calls BLAS. OpenBLAS needs a work area (128 MiB) per concurrent call, and if the
/// address space is limited (ulimit -v) and full, it requests one endlessly. So with a limit, callers wait until there
/// is plenty of room for one more, or no other caller is left; the first one proceeds only if its area fits. Without a
/// limit, no caller waits.
class BlasWorkArea {
  public:
    /// @throws ComputationError if there is no room.
    BlasWorkArea();
    ~BlasWorkArea();
    BlasWorkArea(const BlasWorkArea&) = delete;
    BlasWorkArea& operator=(const BlasWorkArea&) = delete;

  private:
    bool is_counted_ = false;
};

}  // namespace seamflow
