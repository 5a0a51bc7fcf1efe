#include <string>

#include <doctest/doctest.h>

#include "partition/version.h"

TEST_CASE("the headers say the version of the project")
{
    CHECK(seamflow::version == SEAMFLOW_PROJECT_VERSION);
    CHECK(std::to_string(SEAMFLOW_VERSION_MAJOR) + "." + std::to_string(SEAMFLOW_VERSION_MINOR) + "." +
              std::to_string(SEAMFLOW_VERSION_PATCH) ==
          seamflow::version);
}
