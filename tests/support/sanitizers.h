#pragma once

namespace seamflow::test {

/// Whether this is built for a sanitizer that reserves terabytes of addresses and slows all down.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool under_sanitizers = true;
#elif defined(__has_feature)
inline constexpr bool under_sanitizers = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool under_sanitizers = false;
#endif

}  // namespace seamflow::test
