#include "engine/setup/equation_terms.h"

namespace seamflow {

FlowTerms terms_of(const FlowOptions& options, const Points& initial)
{
    return {.initial = &initial,
            .keeps_stiffness = options.flow != FlowEquation::MeanCurvature,
            .keeps_mass = options.flow == FlowEquation::Linear,
            .weights = options.motion.attachment_weights,
            .uniform_weight = options.motion.attachment,
            .step_scales = options.motion.strength};
}

}  // namespace seamflow
