#pragma once

// For what is not compiled at all. GCC says it by macros, clang before version 21 by features alone.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SEAMFLOW_UNDER_SANITIZERS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SEAMFLOW_UNDER_SANITIZERS 1
#else
#define SEAMFLOW_UNDER_SANITIZERS 0
#endif
#else
#define SEAMFLOW_UNDER_SANITIZERS 0
#endif

namespace seamflow::test {

/// Whether this is built for a sanitizer that reserves terabytes of addresses, has an allocator of its own and slows
/// all down.
inline constexpr bool under_sanitizers = SEAMFLOW_UNDER_SANITIZERS != 0;

}  // namespace seamflow::test
