#include "solvers/rounding/smoothest_normals.h"

#include <cstddef>

namespace seamflow {

namespace {

/// How much less a surface bends whose edges are kept, if it is the better one: its bending is below this fraction of
/// that of the other one. Thin vessels of voxels are as good prisms as tubes: fractions are 0.906 to 1.07 for tubes and
/// trees of radius 1 to 2, 0.68 to 0.88 for boxes of 4 to 14 voxels.
constexpr double bends_less = 0.98;
constexpr double bends_less_if_thin = 0.9;
/// The fraction of their bending that thin vessels keep at least. Surfaces of marching cubes bend less from the start.
constexpr double thin_in_voxels = 0.3;
constexpr double thin_in_marching_cubes = 0.5;

}  // namespace

SmoothestNormals::SmoothestNormals(const PolygonMesh& mesh, const Topology& topology, const KeptVolumes& volumes,
                                   const Boxes& boxes, CoordinateBounds::Kind kind, const Executor& exec)
    : kind_(kind)
    , exec_(exec)
    , components_(face_components(mesh, topology))
    , parts_(mesh, topology, components_)
    , normals_(mesh, topology, parts_, volumes, boxes, exec)
{
    if (kind != CoordinateBounds::Kind::Heights)
        before_ = normals_.bending(boxes.middles);
}

std::vector<std::uint8_t> SmoothestNormals::thin_parts(const std::vector<double>& bending) const
{
    const double thin = kind_ == CoordinateBounds::Kind::MarchingCubes ? thin_in_marching_cubes : thin_in_voxels;
    std::vector<std::uint8_t> is_thin(bending.size(), 0);
    for (std::size_t part = 0; part < before_.size(); ++part)
        is_thin[part] = bending[part] >= thin * before_[part] ? 1 : 0;
    return is_thin;
}

void SmoothestNormals::smooth(Points& positions)
{
    Points with_edges = positions;
    const std::vector<double> bending = normals_.smooth(NormalNeighbours::All, positions);
    const std::vector<std::uint8_t> is_thin = thin_parts(bending);
    std::vector<double> to_beat(bending.size());
    for (std::size_t part = 0; part < bending.size(); ++part) {
        const bool is_vessel = is_thin[part] != 0 && kind_ == CoordinateBounds::Kind::Any;
        to_beat[part] = (is_vessel ? bends_less_if_thin : bends_less) * bending[part];
    }
    const std::vector<double> of_edges = normals_.smooth(NormalNeighbours::SameSideOfEdge, with_edges, to_beat);
    std::vector<std::uint8_t> taken(bending.size(), 0);
    for (std::size_t part = 0; part < bending.size(); ++part)
        taken[part] = of_edges[part] < to_beat[part] ? 1 : 0;
    take(taken, with_edges, positions);
}

void SmoothestNormals::take_unless_thin(const Points& from, Points& positions) const
{
    std::vector<std::uint8_t> taken = thin_parts(normals_.bending(from));
    for (std::uint8_t& is_thin : taken)
        is_thin = is_thin != 0 ? 0 : 1;
    take(taken, from, positions);
}

void SmoothestNormals::take(const std::vector<std::uint8_t>& taken, const Points& from, Points& positions) const
{
    for_each(exec_, static_cast<Index>(positions.rows()), [&](Index v) {
        if (const Index part = parts_.of_vertex(v); part >= 0 && taken[part] != 0)
            positions.row(v) = from.row(v);
    });
}

}  // namespace seamflow
