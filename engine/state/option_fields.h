#pragma once

#include <tuple>

#include "engine/options/motion_options.h"
#include "engine/state/transfer.h"

/// The parts of options that checksums and archives take apart (see transfer.h).
namespace seamflow {

auto fields(Is<LengthOnMesh> auto& of)
{
    auto& [value, of_diagonal] = of;
    return std::tie(value, of_diagonal);
}

auto fields(Is<MotionBound> auto& of)
{
    auto& [lengths, along_axes] = of;
    return std::tie(lengths[0], lengths[1], lengths[2], along_axes);
}

auto fields(Is<MotionDirection> auto& of)
{
    auto& [kind, vector] = of;
    return std::tie(kind, vector[0], vector[1], vector[2]);
}

}  // namespace seamflow
