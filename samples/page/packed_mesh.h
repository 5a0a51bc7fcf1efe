#pragma once

#include <cstddef>
#include <string>

#include "samples/page/page_flow.h"

namespace seamflow {

/// The mesh of a page, and the colours of its file, as text that a browser unpacks (see packed()).
struct PackedMesh {
    std::size_t n_triangles = 0;
    /// See PageTriangles.
    std::string corners;
    std::string edges;
    std::string per_face;
    /// Empty if the file has no such colours (see FileColours).
    std::string colours_of_vertices;
    std::string material_of_face;
    /// Of images: two coordinates for each place, and the place of each corner of the triangles.
    PackedPoints places;
    std::string place_of_corner;
};

/// Cuts the faces into triangles, and packs these with their colours.
PackedMesh pack_mesh(const PageMesh& page);

}  // namespace seamflow
