#pragma once

namespace seamflow {

/// Makes OpenBLAS take the work areas that it keeps and uses again: by a product so large that its threads share it,
/// and that no processor's kernels for small matrices do without an area (those for AVX-512 take up to 100³). Where
/// another BLAS is used, or none, it does nothing that matters. There must be room.
void take_blas_work_areas();

/// To be held while a library calls BLAS. OpenBLAS needs a work area (128 MiB) for each call at a time, and where the
/// address space is limited (ulimit -v) and full it asks for one again and again, for ever. So where there is a limit,
/// callers wait until there is plenty of room for one more, or none is left; the first one goes on only if its area
/// fits. Without a limit nobody waits.
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
