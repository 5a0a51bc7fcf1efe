#pragma once

#include <string>
#include <vector>

#include "engine/distributed/conversation.h"
#include "engine/distributed/deal.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// How the faces of a stretch are divided into sub-meshes.
struct DistributedCut {
    /// #F of the stretch.
    std::vector<Index> labels;
    /// How many there are and why, if that was chosen; a sentence each.
    std::vector<std::string> choices;
    /// What the user should know about the cut, one sentence each.
    std::vector<std::string> remarks;
};

/// Cuts a mesh that no rank has as a whole. All ranks call this together.
/// @param slice with labels on all ranks: a given cut, which is repaired as by cut_by_labels; without on all: `options`
///        say how many sub-meshes there are, or leave that open.
/// @throws OptionError for a mesh that is too large for that.
DistributedCut cut_together(Conversation& talk, const RankSlice& slice, const FlowOptions& options);

}  // namespace seamflow
