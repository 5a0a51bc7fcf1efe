#pragma once

namespace seamflow {

/// Makes OpenBLAS allocate the work areas that it keeps and reuses, by a product so large that its threads share it and
/// that no processor's kernels for small matrices, which need no area, take it (with AVX-512, up to 100³). With another
/// BLAS, or none, it has no relevant effect. There must be room.
void take_blas_work_areas();

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
