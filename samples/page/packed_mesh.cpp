#include "samples/page/packed_mesh.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "samples/page/packed_array.h"
#include "samples/page/page_triangles.h"

namespace seamflow {

namespace {

/// For each corner of the triangles, its place in an image.
std::vector<std::uint32_t> places_of(const PageTriangles& triangles, const PolygonMesh& mesh,
                                     const std::vector<Index>& place_of_corner)
{
    std::vector<std::uint32_t> places;
    std::size_t next = 0;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        for (std::uint32_t k = 0; k < 3 * triangles.per_face[f]; ++k, ++next) {
            const auto v = static_cast<Index>(triangles.corners[next]);
            const auto in_face = static_cast<Index>(std::find(face.begin(), face.end(), v) - face.begin());
            places.push_back(static_cast<std::uint32_t>(place_of_corner[mesh.face_offsets[f] + in_face]));
        }
    }
    return places;
}

/// Packs the colours that the file has.
void pack_colours(const FileColours& colours, const PageTriangles& triangles, const PolygonMesh& mesh,
                  PackedMesh& result)
{
    if (!colours.of_vertices.empty()) {
        std::vector<std::uint8_t> bytes;
        for (const Colour& colour : colours.of_vertices)
            bytes.insert(bytes.end(), colour.begin(), colour.end());
        result.colours_of_vertices = packed(std::span<const std::uint8_t>(bytes));
    }
    if (colours.materials.empty())
        return;
    const std::vector<std::uint32_t> of_faces(colours.material_of_face.begin(), colours.material_of_face.end());
    result.material_of_face = packed(std::span<const std::uint32_t>(of_faces), 1);
    if (colours.place_of_corner.empty())
        return;
    Points places = Points::Zero(static_cast<Eigen::Index>(colours.places.size()), 3);
    for (std::size_t k = 0; k < colours.places.size(); ++k)
        for (std::size_t c = 0; c < 2; ++c)
            places(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = colours.places[k][c];
    result.places = pack_points(places);
    const std::vector<std::uint32_t> of_corners = places_of(triangles, mesh, colours.place_of_corner);
    result.place_of_corner = packed(std::span<const std::uint32_t>(of_corners), 3);
}

}  // namespace

PackedMesh pack_mesh(const PageMesh& page)
{
    const PageTriangles triangles = page_triangles(page.mesh, page.topology);
    PackedMesh result;
    pack_colours(page.colours, triangles, page.mesh, result);
    result.n_triangles = triangles.edges.size();
    result.corners = packed(std::span<const std::uint32_t>(triangles.corners), 3);
    result.edges = packed(std::span<const std::uint8_t>(triangles.edges));
    result.per_face = packed(std::span<const std::uint32_t>(triangles.per_face), 1);
    return result;
}

}  // namespace seamflow
