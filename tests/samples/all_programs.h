#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace seamflow::test {

/// The paths of the programs that were built.
inline std::vector<std::string> all_programs()
{
    std::istringstream paths(ALL_PROGRAMS);
    return {std::istream_iterator<std::string>(paths), {}};
}

}  // namespace seamflow::test
