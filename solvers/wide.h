#pragma once

/// Before a function whose loops pay in wider registers: compiled once more for machines that have them. The operations
/// are the same, and so are the results. Nothing in such a function may throw: GCC 12 lets no exception out of it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define SEAMFLOW_WIDE __attribute__((flatten, target_clones("avx2", "default")))
#else
#define SEAMFLOW_WIDE
#endif
