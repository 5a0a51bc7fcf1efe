#pragma once

#include <algorithm>
#include <span>

#include "solvers/geometry.h"

namespace seamflow {

/// W_V of the paper (eq. 11), inverted: the area of each vertex, Σ |f| / p over its faces f, p-gons, in length².
/// @param face_areas #F, receives |f|.
/// @param vertex_areas #V, receives the sums.
inline void measure_areas(const FaceView& faces, const Points& positions, std::span<double> face_areas,
                          std::span<double> vertex_areas)
{
    std::fill(vertex_areas.begin(), vertex_areas.end(), 0.0);
    for (Index f = 0; f < faces.n_faces(); ++f) {
        const auto corners = faces.face(f);
        face_areas[at(f)] = area(corners, positions);
        for (const Index v : corners)
            vertex_areas[at(v)] += face_areas[at(f)] / static_cast<double>(corners.size());
    }
}

}  // namespace seamflow
