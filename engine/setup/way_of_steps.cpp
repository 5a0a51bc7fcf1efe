#include "engine/setup/way_of_steps.h"

namespace seamflow {

Approach approach_of(const WayOfSteps& way)
{
    return std::visit([](const auto& steps) { return steps.approach; }, way);
}

std::optional<double> tolerance_of(const WayOfSteps& way)
{
    return std::visit(
        [](const auto& steps) -> std::optional<double> {
            if constexpr (requires { steps.stop; })
                return steps.stop.tolerance;
            else if constexpr (requires { steps.tolerance; })
                return steps.tolerance;
            else
                return {};
        },
        way);
}

bool takes_whole_mesh(const WayOfSteps& way)
{
    return std::visit([](const auto& steps) { return steps.is_whole; }, way);
}

}  // namespace seamflow
