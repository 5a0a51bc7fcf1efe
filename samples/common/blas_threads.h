#pragma once

namespace seamflow {

/// Starts the program anew without threads of OpenBLAS where its address space is limited (ulimit -v). Those start with
/// the program, each asks for 128 MiB, and where it does not get them it asks again, for ever; the end of the program
/// waits for it. Nothing happens where there is no limit, or the user has said how many threads there are to be
/// (OPENBLAS_NUM_THREADS). To be called before anything is read or written.
void do_without_blas_threads_where_limited();

}  // namespace seamflow
