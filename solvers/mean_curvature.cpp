#include "solvers/mean_curvature.h"

#include "partition/errors.h"

namespace seamflow {

namespace {

/// A mesh at certain positions.
struct Surface {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& positions;
};

Point fujiwara(const Surface& s, Index v)
{
    Point sum = Point::Zero();
    double degree = 0.0;
    double length = 0.0;
    const Point here = s.positions.row(v);
    for (const Index corner : s.topology.corners_at(v))
        for (const Index end : {s.topology.next(s.mesh, corner), s.topology.previous(s.mesh, corner)}) {
            const Point difference = here - s.positions.row(s.mesh.face_vertices[at(end)]);
            const double norm = difference.norm();
            sum += (1.0 / norm) * difference;
            length += norm;
            degree += 1.0;
        }
    // Every edge of an interior vertex has been met twice: half of each of degree, length and sum.
    return (degree / length) * 0.5 * sum;
}

/// Σₖ bₖ vₖᵀ / |f| of face f: the map from an edge vector to the flux of the positions across the edge.
Eigen::Matrix3d flux_map(const Surface& s, Index f)
{
    const auto corners = s.mesh.face(f);
    const Point origin = s.positions.row(corners[0]);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 1; k < corners.size(); ++k)
        sum += corner_bisector(corners, k, s.positions).transpose() * (s.positions.row(corners[k]) - origin);
    return sum / area(corners, s.positions);
}

Index corner_in_face(const Surface& s, Index corner)
{
    return corner - s.mesh.face_offsets[at(s.topology.face_of[at(corner)])];
}

double vertex_area(const Surface& s, Index v)
{
    double sum = 0.0;
    for (const Index corner : s.topology.corners_at(v)) {
        const auto corners = s.mesh.face(s.topology.face_of[at(corner)]);
        sum += area(corners, s.positions) / static_cast<double>(corners.size());
    }
    return sum;
}

/// What one corner adds to K V at its vertex, and to the vertex's area.
struct CornerShare {
    Point of_product;
    double of_area;
};

/// The bisectors of a triangle are half the opposite edges, and each row of its matrix sums to zero.
CornerShare share_in_triangle(const Surface& s, Index corner)
{
    const Point here = s.positions.row(s.mesh.face_vertices[at(corner)]);
    const Point first = s.positions.row(s.mesh.face_vertices[at(s.topology.next(s.mesh, corner))]) - here;
    const Point second = s.positions.row(s.mesh.face_vertices[at(s.topology.previous(s.mesh, corner))]) - here;
    const double double_area = first.cross(second).norm();
    const Point difference = first - second;
    const Point weighted = second.dot(difference) * first - first.dot(difference) * second;
    return {0.5 / double_area * weighted, double_area / 6.0};
}

CornerShare share_in_polygon(const Surface& s, Index corner, std::span<const Index> corners)
{
    const Point bisector = corner_bisector(corners, at(corner_in_face(s, corner)), s.positions);
    const Point origin = s.positions.row(corners[0]);
    Point sum = Point::Zero();
    for (std::size_t k = 1; k < corners.size(); ++k)
        sum += bisector.dot(corner_bisector(corners, k, s.positions)) * (s.positions.row(corners[k]) - origin);
    const double face_area = area(corners, s.positions);
    return {sum / face_area, face_area / static_cast<double>(corners.size())};
}

Point alexa_wardetzky(const Surface& s, Index v)
{
    Point sum = Point::Zero();
    double vertex_area = 0.0;
    for (const Index corner : s.topology.corners_at(v)) {
        const auto corners = s.mesh.face(s.topology.face_of[at(corner)]);
        const CornerShare share =
            corners.size() == 3 ? share_in_triangle(s, corner) : share_in_polygon(s, corner, corners);
        sum += share.of_product;
        vertex_area += share.of_area;
    }
    return sum / vertex_area;
}

/// Flux of the positions across half-edge h, out of its face.
Point flux(const Surface& s, Index h)
{
    const Point edge = s.positions.row(s.mesh.face_vertices[at(s.topology.next(s.mesh, h))]) -
                       s.positions.row(s.mesh.face_vertices[at(h)]);
    return edge * flux_map(s, s.topology.face_of[at(h)]);
}

Point ptackova_velho(const Surface& s, Index v)
{
    Point sum = Point::Zero();
    for (const Index corner : s.topology.corners_at(v)) {
        const Index f = s.topology.face_of[at(corner)];
        Point of_face = Point::Zero();
        for (Index h = s.mesh.face_offsets[at(f)]; h < s.mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = s.topology.twin[at(h)];
            of_face += twin >= 0 ? flux(s, twin) : Point(-flux(s, h));
        }
        sum += of_face / (2.0 * static_cast<double>(s.mesh.face(f).size()));
    }
    return sum / vertex_area(s, v);
}

}  // namespace

Point mean_curvature_vector(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                            Laplacian laplacian, Index v)
{
    const Surface surface{mesh, topology, positions};
    switch (laplacian) {
    case Laplacian::Fujiwara:
        return fujiwara(surface, v);
    case Laplacian::AlexaWardetzky:
        return alexa_wardetzky(surface, v);
    case Laplacian::PtackovaVelho:
        return ptackova_velho(surface, v);
    }
    throw OptionError("no such Laplacian");
}

}  // namespace seamflow
