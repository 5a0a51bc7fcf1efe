#include "engine/setup/way_of_steps.h"

#include <array>

namespace seamflow {

Approach approach_of(const WayOfSteps& way)
{
    constexpr std::array names{Approach::Sweep, Approach::Converged, Approach::ConjugateGradients,
                               Approach::Undecomposed, Approach::Sweep};
    static_assert(names.size() == std::variant_size_v<WayOfSteps>);
    return names.at(way.index());
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
    return std::holds_alternative<GradientSteps>(way) || std::holds_alternative<UndecomposedSteps>(way) ||
           std::holds_alternative<ExplicitSteps>(way);
}

}  // namespace seamflow
