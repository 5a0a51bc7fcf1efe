#include "engine/denoise/resolved_denoise.h"

#include <variant>

#include "engine/motion/resolved_motion.h"

namespace seamflow {

SmoothingAmount* amount_of(DenoiseMethod& method)
{
    if (auto* const between = std::get_if<SmoothBetweenEdges>(&method))
        return &between->amount;
    auto* const rims = std::get_if<SmoothRims>(&method);
    return rims != nullptr ? &rims->amount : nullptr;
}

DenoiseOptions resolved(const DenoiseOptions& options, const PolygonMesh& mesh, LengthScale& scale,
                        const Executor& exec, std::vector<Remark>& remarks)
{
    DenoiseOptions own = options;
    own.motion = resolved(options.motion, mesh, scale, exec, remarks);
    if (SmoothingAmount* const amount = amount_of(own.method))
        *amount = {.time_step = time_step_of(*amount, own.steps, scale)};
    return own;
}

}  // namespace seamflow
