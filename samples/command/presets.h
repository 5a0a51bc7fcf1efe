#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/setup/presets.h"

namespace seamflow {

/// One of the options that have the same effect as a preset, besides its amount.
struct PresetOption {
    /// "--steps", "3"; empty: only the preset sets it.
    std::string_view name;
    std::string value;
    /// Applies the option.
    std::function<void(AllOptions& options, std::optional<LengthOnMesh>& attach)> set;
};

/// @param denoise instead of the equation of the preset.
std::vector<PresetOption> options_of(const PresetTraits& preset, bool denoise);

/// The amount as an option, "--radius 3%"; empty if it follows from the noise of a mesh.
std::string amount_of(const PresetTraits& preset);

}  // namespace seamflow
