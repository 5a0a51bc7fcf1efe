#include "solvers/rounding/smoothest_normals.h"

#include <algorithm>
#include <cstddef>

namespace seamflow {

namespace {

/// How much less a surface bends whose edges are kept, if it is the better one: its bending is below this fraction of
/// that of the other one. Thin vessels of voxels are as good prisms as tubes: fractions are 0.906 to 1.07 for tubes and
/// trees of radius 1 to 2, 0.68 to 0.88 for boxes of 4 to 14 voxels.
constexpr double bends_less = 0.98;
constexpr double bends_less_if_thin = 0.9;
/// The fractions of their bending that thin vessels keep at least, where it is decided on edges, and where on smoothing
/// once more. Vessels of radius 1.7 to 2.5, which keep 0.19 to 0.3, would become prisms; folds and egg crates keep 0.08
/// to 0.15. Surfaces of marching cubes bend less from the start: there folds keep 0.3 to 0.45, vessels 0.6 and more.
constexpr double thin_in_voxels = 0.3;
constexpr double smoothed_once_in_voxels = 0.18;
constexpr double thin_in_marching_cubes = 0.5;
/// The fraction of the vertices of a part that is many.
constexpr double many = 0.2;

}  // namespace

SmoothestNormals::SmoothestNormals(const PolygonMesh& mesh, const Topology& topology, const KeptVolumes& volumes,
                                   const Boxes& boxes, CoordinateBounds::Kind kind, const Executor& exec)
    : kind_(kind)
    , exec_(exec)
    , components_(face_components(mesh, topology))
    , parts_(mesh, topology, components_)
    , normals_(mesh, topology, parts_, volumes, boxes, exec)
    , boxes_(boxes)
{
    if (kind != CoordinateBounds::Kind::Heights)
        before_ = normals_.bending(boxes.middles);
}

std::vector<std::uint8_t> SmoothestNormals::parts_that_keep(double of_voxels, double of_marching_cubes) const
{
    const double least = kind_ == CoordinateBounds::Kind::MarchingCubes ? of_marching_cubes : of_voxels;
    std::vector<std::uint8_t> keeps(smooth_.size(), 0);
    for (std::size_t part = 0; part < before_.size(); ++part)
        keeps[part] = smooth_[part] >= least * before_[part] ? 1 : 0;
    return keeps;
}

void SmoothestNormals::smooth(Points& positions)
{
    Points with_edges = positions;
    smooth_ = normals_.smooth(NormalNeighbours::All, positions);
    const std::vector<std::uint8_t> is_thin = parts_that_keep(thin_in_voxels, thin_in_marching_cubes);
    std::vector<double> to_beat(smooth_.size());
    for (std::size_t part = 0; part < smooth_.size(); ++part) {
        const bool is_vessel = is_thin[part] != 0 && kind_ == CoordinateBounds::Kind::Any;
        to_beat[part] = (is_vessel ? bends_less_if_thin : bends_less) * smooth_[part];
    }
    const std::vector<double> of_edges = normals_.smooth(NormalNeighbours::SameSideOfEdge, with_edges, to_beat);
    std::vector<std::uint8_t> has_edges(smooth_.size(), 0);
    for (std::size_t part = 0; part < smooth_.size(); ++part)
        has_edges[part] = of_edges[part] < to_beat[part] ? 1 : 0;
    take(has_edges, with_edges, positions);
}

void SmoothestNormals::smooth_again(const std::vector<Index>& vertices, const std::function<void(Points&)>& change,
                                    Points& positions)
{
    std::vector<double> n_given(smooth_.size(), 0.0);
    for (const Index v : vertices)
        if (const Index part = parts_.of_vertex(v); part >= 0)
            ++n_given[part];
    std::vector<double> n_moving(smooth_.size(), 0.0);
    for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v)
        if (const Index part = parts_.of_vertex(v); part >= 0 && !boxes_.half_widths.row(v).isZero(0.0))
            ++n_moving[part];
    std::vector<std::uint8_t> taken = parts_that_keep(smoothed_once_in_voxels, thin_in_marching_cubes);
    for (std::size_t part = 0; part < taken.size(); ++part)
        taken[part] = taken[part] == 0 && n_given[part] > many * n_moving[part] ? 1 : 0;
    if (std::ranges::find(taken, 1) == taken.end())
        return;
    Points again = positions;
    smooth(again);
    change(again);
    take(taken, again, positions);
}

void SmoothestNormals::take(const std::vector<std::uint8_t>& taken, const Points& from, Points& positions) const
{
    for_each(exec_, static_cast<Index>(positions.rows()), [&](Index v) {
        if (const Index part = parts_.of_vertex(v); part >= 0 && taken[part] != 0)
            positions.row(v) = from.row(v);
    });
}

}  // namespace seamflow
