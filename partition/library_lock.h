#pragma once

#include <mutex>

namespace seamflow {

/// For libraries that are not made for several callers at a time (METIS), or have no room for them (OpenBLAS where
/// memory is limited): one of each for the whole process.
using LibraryMutex = std::mutex;
using LibraryLock = std::unique_lock<LibraryMutex>;

}  // namespace seamflow
