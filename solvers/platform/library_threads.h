#pragma once

namespace seamflow {

/// Ends the threads that BLAS started when the program was loaded; BLAS starts new ones when it needs them. For
/// programs that set properties which threads inherit from their creator, and must do so first.
void end_threads_of_blas();

/// Keeps BLAS on one thread for the whole process while at least one such object exists, then restores its number of
/// threads. Does nothing for a BLAS that is not OpenBLAS.
class SingleThreadedBlas {
  public:
    SingleThreadedBlas();
    ~SingleThreadedBlas();
    SingleThreadedBlas(const SingleThreadedBlas&) = delete;
    SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
};

/// Keeps OpenMP regions that the calling thread starts on that one thread while this object exists. Must be destroyed
/// in the same thread. Does nothing without OpenMP.
class SingleThreadedOpenMp {
  public:
    SingleThreadedOpenMp();
    ~SingleThreadedOpenMp();
    SingleThreadedOpenMp(const SingleThreadedOpenMp&) = delete;
    SingleThreadedOpenMp& operator=(const SingleThreadedOpenMp&) = delete;

  private:
    int levels_before_ = 0;
};

}  // namespace seamflow
