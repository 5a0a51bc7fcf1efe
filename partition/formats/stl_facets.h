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

    /// @param slice without vertices: those of the faces are the points in it.
    FacetCollector(const InputPosition& position, const MeshSlice& slice)
        : position_(position)
        , builder_(position, 0, slice)
    {
    }

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

    /// The points, by their numbers.
    /// @param is_whole whether there are no other slices. @throws InputError if there are none then.
    [[nodiscard]] std::vector<Corner> take_points(bool is_whole)
    {
        if (is_whole)
            require_vertices(position_, std::ssize(numbers_.points()));
        return numbers_.take_points();
    }

    /// Makes room for as many points as there are facets, about twice as many as there are: a table with much room is
    /// faster.
    void expect_facets(std::size_t n) { numbers_.reserve(n); }

  private:
    static constexpr Real no_place = std::numeric_limits<Real>::quiet_NaN();

    /// Most facets share corners with the one before them.
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
    /// Of the last facet; at first equal to nothing.
    std::array<Corner, 3> last_points_ = {Corner{no_place}, Corner{no_place}, Corner{no_place}};
    std::array<Index, 3> last_corners_ = {};
    Index n_facets_ = 0;
};

/// Reads slices, several at a time. Points are numbered within each slice, and then for all slices.
/// @param read called with a slice and where its faces go; returns its points.
template <class Real>
PolygonMesh
join_facets(Index n_slices, const Executor& exec,
            const std::function<std::vector<std::array<Real, 3>>(Index slice, const MeshSlice& place)>& read)
{
    PolygonMesh mesh;
    std::vector<std::vector<std::array<Real, 3>>> of_slice(usize(n_slices));
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
