#pragma once

namespace seamflow {

/// Keeps BLAS on one thread for the whole process while at least one of these lives, and then gives it back the number
/// of threads that it had. Does nothing for a BLAS that is not OpenBLAS.
class SingleThreadedBlas {
  public:
    SingleThreadedBlas();
    ~SingleThreadedBlas();
    SingleThreadedBlas(const SingleThreadedBlas&) = delete;
    SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
};

/// Keeps OpenMP regions that are started from the calling thread on that one thread.
/// @returns what `restore_openmp_threads` needs to undo it.
int forbid_openmp_threads();

/// Undoes forbid_openmp_threads in the same thread.
void restore_openmp_threads(int levels);

}  // namespace seamflow
