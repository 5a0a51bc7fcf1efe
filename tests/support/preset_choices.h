#pragma once

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "engine/setup/presets.h"

namespace seamflow::test {

/// Goes through the door that a preset has chosen.
inline Points moved_by(const PresetChoice& choice, PolygonMesh mesh)
{
    if (choice.denoise)
        denoise(mesh, *choice.denoise);
    else
        mean_curvature_flow(mesh, choice.options);
    return mesh.vertices;
}

}  // namespace seamflow::test
