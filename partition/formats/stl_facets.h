#pragma once

#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/io/input_position.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/numbered_points.h"
#include "partition/io/slices.h"
#include "partition/point_numbers.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Joins the corners of facets to vertices, and facets to faces, in a slice of a file.
/// @tparam Real double or float: the type of the coordinates in the file.
template <class Real>
class FacetCollector {
  public:
    using Corner = std::array<Real, 3>;

    /// @param slice without vertices: its faces have the numbers of points of the slice.
    FacetCollector(const InputPosition& position, const MeshSlice& slice)
        : position_(position)
        , builder_(position, 0, slice)
    {
    }

    /// Adds a facet. A facet of which two corners coincide is a harmless fault, and no face.
    void add(const std::array<Corner, 3>& points)
    {
        const Index number = n_facets_++;
        if (points[0] == points[1] || points[1] == points[2] || points[2] == points[0]) {
            position_.harmless_fault("two corners of the facet have the same coordinates; remove the facet");
            position_.leave_out_face(number);
            return;
        }
        const std::array<Index, 3> corners = {number_of(points[0]), number_of(points[1]), number_of(points[2])};
        builder_.add_face(corners);
        last_points_ = points;
        last_corners_ = corners;
    }

    /// Moves out the points, in the order of their numbers.
    /// @param is_whole whether there are no other slices. @throws InputError if there are no points, and no other
    /// slices.
    [[nodiscard]] std::vector<Corner> take_points(bool is_whole)
    {
        if (is_whole)
            require_vertices(position_, std::ssize(numbers_.points()));
        return numbers_.take_points();
    }

    /// Reserves memory for as many points as there are facets, about twice as many as there are points: a table with
    /// much room is faster.
    void expect_facets(std::size_t n) { numbers_.reserve(n); }

  private:
    static constexpr Real no_coordinate = std::numeric_limits<Real>::quiet_NaN();

    /// Compares with the last facet first, because most facets share corners with the one before them.
    Index number_of(const Corner& point)
    {
        for (std::size_t i = 0; i < last_points_.size(); ++i)
            if (last_points_[i] == point)
                return last_corners_[i];
        return numbers_(point);
    }

    const InputPosition& position_;
    MeshBuilder builder_;
    BasicPointNumbers<Real> numbers_;
    /// The corners of the last facet; before the first facet NaN, which equals no corner.
    std::array<Corner, 3> last_points_ = {Corner{no_coordinate}, Corner{no_coordinate}, Corner{no_coordinate}};
    std::array<Index, 3> last_corners_ = {};
    Index n_facets_ = 0;
};

/// Reads a file of facets in slices, several at a time, and joins these to one mesh. Points with the same coordinates
/// become one vertex, also across slices.
/// @param read adds the faces of a slice to the MeshSlice, with the numbers of points in that slice; returns these
///        points in the order of their numbers.
template <class Real>
PolygonMesh
join_facets(Index n_slices, const Executor& exec,
            const std::function<std::vector<std::array<Real, 3>>(Index slice, const MeshSlice& mesh_slice)>& read)
{
    PolygonMesh mesh;
    std::vector<std::vector<std::array<Real, 3>>> of_slice(usize(n_slices));
    // The number of corners before each slice.
    std::vector<Index> corners(usize(n_slices) + 1, 0);
    Points none(0, 3);
    append_faces(mesh, n_slices, exec, [&](Index i, PolygonMesh& part) {
        of_slice[i] = read(i, {none, 0, part});
        corners[i + 1] = part.n_corners();
    });
    std::partial_sum(corners.begin(), corners.end(), corners.begin());
    NumberedPoints all = number_together<Real>(of_slice, exec);
    if (all.points.rows() == 0)
        throw InputError("no vertices");
    for_each(exec, n_slices, [&](Index i) {
        for (Index corner = corners[i]; corner < corners[i + 1]; ++corner) {
            Index& v = mesh.face_vertices[corner];
            v = all.numbers[all.begin[i] + v];
        }
    });
    mesh.vertices = std::move(all.points);
    return mesh;
}

}  // namespace seamflow
