#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The quantity that an error map shows at each vertex of the candidate.
enum class Shown {
    /// Its distance from the surface of the reference.
    SurfaceDistance,
    /// Its distance from the corresponding vertex of the reference.
    VertexDistance,
    /// How far it was moved along the surface from its position in the reference.
    Tangential,
    /// How far it was moved along the normal, negative against it.
    Normal,
};

/// The range of an error map, in units of length.
struct ErrorRange {
    /// 0, or for Shown::Normal minus the last.
    double first = 0.0;
    double last = 0.0;
};

/// Writes the candidate, each vertex with its colour (rainbow_colour of value / last, for Shown::Normal signed_colour)
/// and values in units of length: `distance` for the distances; `tangential`, `normal` and their joint length
/// `distance` for the parts of the displacement. Undefined values are not a number, and grey.
/// @param last the value that gets the last colour, positive; empty: the largest.
/// @returns the range of the colours.
/// @throws InputError if this cannot be shown for these meshes; OutputError.
ErrorRange write_error_map(const std::filesystem::path& path, const PolygonMesh& reference,
                           const PolygonMesh& candidate, Shown shown, std::optional<double> last);

}  // namespace seamflow
