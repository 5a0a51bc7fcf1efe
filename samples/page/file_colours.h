#pragma once

#include <array>
#include <string>
#include <vector>

#include "partition/formats/palette.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The appearance of the faces of a material.
struct FileMaterial {
    Colour colour = {255, 255, 255};
    /// The image that textures them, as a data URL (RFC 2397); empty: only the colour.
    std::string image;
};

/// Colours and textures that a mesh file has besides its surface, as far as a page shows them.
struct FileColours {
    /// #V; empty: the vertices have none.
    std::vector<Colour> of_vertices;
    /// Empty: the faces have none.
    std::vector<FileMaterial> materials;
    /// #F, an index into `materials`; empty without these.
    std::vector<Index> material_of_face;
    /// Points in an image: 0, 0 is its lower left corner, 1, 1 its upper right one; outside, the image repeats.
    std::vector<std::array<float, 2>> places;
    /// One per corner of every face, as PolygonMesh::face_vertices: an index into `places`; empty without images.
    std::vector<Index> place_of_corner;
    /// Sentences for the user: images that are missing or that no browser shows.
    std::vector<std::string> remarks;
};

}  // namespace seamflow
