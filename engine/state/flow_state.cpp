#include "engine/state/flow_state.h"

#include <fmt/format.h>

#include "engine/options/option_rule.h"
#include "partition/errors.h"

namespace seamflow {

void require_identity(const FlowState& state, std::uint64_t identity)
{
    if (state.identity != identity)
        throw InputError("the state to resume from belongs to another mesh or to other options: resume with those "
                         "that made it");
}

void require_not_beyond(const FlowState& state, int steps)
{
    if (state.n_steps() > steps)
        refuse(fmt::format("<steps> is {}, but the state to resume from is already after step {}: ask for at least as "
                           "many, or start over",
                           steps, state.n_steps()));
}

}  // namespace seamflow
