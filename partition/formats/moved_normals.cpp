#include "partition/formats/moved_normals.h"

#include <utility>

namespace seamflow {

namespace {

std::optional<Point> on_the_side_of(const Point& given, const Point& before, const Point& after)
{
    if (after == before || after == Point::Zero())
        return std::nullopt;
    const double side = given.dot(before) < 0.0 ? -1.0 : 1.0;
    // The sum has no negative zeros, which nobody likes to read.
    return Point(side * after + Point::Zero());
}

}  // namespace

MovedNormals::MovedNormals(const PolygonMesh& mesh, Points before)
    : mesh_(mesh)
    , before_(std::move(before))
    , topology_(make_topology(mesh))
    , normals_(mesh, topology_)
{
}

std::optional<Point> MovedNormals::around_vertex(std::span<const Index> corners, const Point& given) const
{
    return on_the_side_of(given, normals_(corners, before_), normals_(corners, mesh_.vertices));
}

std::optional<Point> MovedNormals::of_face(Index f, const Point& given) const
{
    const auto normal = [&](const Points& positions) {
        Point area = vector_area(mesh_.face(f), positions);
        area.stableNormalize();
        return area;
    };
    return on_the_side_of(given, normal(before_), normal(mesh_.vertices));
}

}  // namespace seamflow
