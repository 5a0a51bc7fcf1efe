#include "partition/metrics/centre_fans.h"

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

Point centre_of(std::span<const Index> face, const Points& positions)
{
    Point sum = Point::Zero();
    for (const Index v : face)
        sum += positions.row(v);
    return sum / static_cast<double>(face.size());
}

/// Whether every triangle of the fan lies on the side of the face's vector area.
bool turns_one_way(std::span<const Index> face, const Point& centre, const Points& positions)
{
    const Point area = vector_area(face, positions);
    for (std::size_t k = 0; k < face.size(); ++k) {
        const Point a = positions.row(face[k]);
        const Point b = positions.row(face[(k + 1) % face.size()]);
        if (!((a - centre).cross(b - centre).dot(area) > 0.0))
            return false;
    }
    return true;
}

}  // namespace

CentreFans fans_around_centres(const PolygonMesh& mesh, const Points& positions)
{
    CentreFans fans;
    std::vector<Point> centres;
    std::vector<Triangle> cut;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        const Point centre = centre_of(face, positions);
        if (face.size() > 3 && turns_one_way(face, centre, positions)) {
            const auto number = mesh.n_vertices() + static_cast<Index>(centres.size());
            centres.push_back(centre);
            for (std::size_t k = 0; k < face.size(); ++k)
                fans.triangles.add_face(std::array{number, face[k], face[(k + 1) % face.size()]});
        } else {
            cut.clear();
            triangulate(face, positions, cut);
            for (const Triangle& triangle : cut)
                fans.triangles.add_face(triangle);
        }
        fans.faces.resize(fans.triangles.n_faces(), f);
    }
    fans.triangles.vertices.resize(positions.rows() + static_cast<Eigen::Index>(centres.size()), 3);
    fans.triangles.vertices.topRows(positions.rows()) = positions;
    for (std::size_t k = 0; k < centres.size(); ++k)
        fans.triangles.vertices.row(positions.rows() + static_cast<Eigen::Index>(k)) = centres[k];
    return fans;
}

}  // namespace seamflow
