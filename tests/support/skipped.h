#pragma once

#include <string>

#include <doctest/doctest.h>

namespace seamflow::test {

/// How many tests of the executable found no ground to stand on. Its main then ends with status 77, and ctest says that
/// it was skipped: what was not tested does not pass.
inline int n_skipped = 0;

/// For a test that cannot be made here, which returns then.
/// @param reason what is missing.
inline void skip(const std::string& reason)
{
    ++n_skipped;
    MESSAGE("skipped: ", reason);
}

}  // namespace seamflow::test
