#include "tests/support/memory_limits.h"

#include <regex>

#include "partition/errors.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

namespace seamflow::test {

std::optional<std::size_t> least_limit_named(const std::string& message)
{
    std::smatch match;
    if (!std::regex_search(message, match, std::regex("memory_limit is [0-9]+ bytes.* take ([0-9]+)")))
        return std::nullopt;
    return std::stoul(match[1]);
}

std::optional<std::size_t> least_memory_limit(const PolygonMesh& mesh, FlowOptions options)
{
    options.resources.memory_limit = 1;
    return least_limit_named(message_of<OptionError>([&] { flowed(mesh, options); }));
}

}  // namespace seamflow::test
