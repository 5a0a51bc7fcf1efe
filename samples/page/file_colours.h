#pragma once

#include <array>
#include <string>
#include <vector>

#include "partition/formats/palette.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What the faces of a material look like.
struct FileMaterial {
    Colour colour = {255, 255, 255};
    /// The image that is laid on them, as a data URL (RFC 2397); empty: none, only the colour.
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
    /// Places in an image: 0, 0 is its lower left corner, 1, 1 its upper right one; beyond, it is repeated.
    std::vector<std::array<float, 2>> places;
    /// One per corner of every face, as PolygonMesh::face_vertices: an index into `places`; empty without images.
    std::vector<Index> place_of_corner;
    /// Sentences for the user: images that are missing or that no browser shows.
    std::vector<std::string> remarks;
};

}  // namespace seamflow
