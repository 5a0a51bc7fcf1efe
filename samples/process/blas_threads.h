#pragma once

namespace seamflow {

/// Starts the program anew without threads of OpenBLAS where its address space is limited (ulimit -v). Those threads
/// start with the program, and each asks for 128 MiB. A thread that does not get them asks again without end, and the
/// end of the program waits for it. Nothing happens without a limit, or where the user has set the number of threads
/// (OPENBLAS_NUM_THREADS). To be called before anything is read or written.
void do_without_blas_threads_where_limited();

}  // namespace seamflow
