#pragma once

namespace seamflow {

/// Restarts the program without threads of OpenBLAS if its address space is limited (ulimit -v). Those threads start
/// with the program, and each requests 128 MiB. A thread that does not get them retries forever, and the end of the
/// program waits for it. Nothing happens without a limit, or if the user has set the number of threads
/// (OPENBLAS_NUM_THREADS). Must be called before anything is read or written.
void do_without_blas_threads_where_limited();

}  // namespace seamflow
