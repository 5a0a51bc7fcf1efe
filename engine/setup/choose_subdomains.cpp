#include "engine/setup/choose_subdomains.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs)
{
    const double width = needs.width * std::sqrt(time_step);
    const double most_by_width = std::floor(size.area / (width * width));
    const double most_by_cost = std::floor(size.vertices / static_cast<double>(needs.vertices));
    SubdomainChoice choice;
    choice.count = static_cast<Index>(std::max(1.0, std::min(most_by_width, most_by_cost)));
    choice.reason = std::to_string(choice.count) + (choice.count == 1 ? " sub-mesh" : " sub-meshes") + " chosen: ";
    const std::string least_width = std::to_string(static_cast<int>(needs.width)) + " √dt";
    if (most_by_width < most_by_cost)
        choice.reason += "more would be narrower than " + least_width;
    else
        choice.reason +=
            "blocks of about " + std::to_string(needs.vertices) + " vertices are cheap, and wide enough against √dt";
    return choice;
}

double width_in_diffusion_lengths(double area, Index k, double time_step)
{
    return std::sqrt(area / k / time_step);
}

}  // namespace seamflow
