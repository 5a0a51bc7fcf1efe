#include "partition/metrics/triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

using Point2 = Eigen::RowVector2d;

/// The quality of an ear; better qualities first.
enum class Quality {
    /// The corner turns left, and no other corner lies in its triangle.
    Clean,
    /// The corner is collinear with its neighbours, or so nearly that rounding decides.
    Flat,
    /// Neither; only a polygon that crosses itself has no better ears.
    None,
};

/// A corner that could be cut off. The smallest ear is cut off first: by quality, then by diagonal, then by number.
struct Ear {
    Quality quality = Quality::None;
    /// The squared length of the diagonal.
    double diagonal = std::numeric_limits<double>::infinity();
    Index vertex = 0;

    friend auto operator<=>(const Ear&, const Ear&) = default;
};

/// Twice the area of triangle abc, positive if the path from a by b to c turns left.
double turn(const Point2& a, const Point2& b, const Point2& c)
{
    const Point2 u = b - a;
    const Point2 w = c - b;
    return u.x() * w.y() - u.y() * w.x();
}

/// The remaining polygon, seen along the vector area of the whole polygon, and its ears.
class EarClipper {
  public:
    EarClipper(std::span<const Index> corners, const Points& positions);
    void run(std::vector<Triangle>& triangles);

  private:
    [[nodiscard]] std::size_t after(std::size_t k) const { return k + 1 == left_.size() ? 0 : k + 1; }
    [[nodiscard]] std::size_t before(std::size_t k) const { return k == 0 ? left_.size() - 1 : k - 1; }
    [[nodiscard]] const Point2& flat(std::size_t k) const { return flat_[left_[k]]; }
    [[nodiscard]] Index vertex(std::size_t k) const { return corners_[left_[k]]; }
    [[nodiscard]] Quality quality_of(std::size_t k) const;
    [[nodiscard]] bool is_empty(const Point2& a, const Point2& b, const Point2& c) const;
    void examine(std::size_t k);
    void examine_around(std::size_t k, Quality quality);

    std::span<const Index> corners_;
    const Points& positions_;
    /// For each corner of the polygon, its projection onto a plane normal to the vector area.
    std::vector<Point2> flat_;
    /// The remaining corners, as indices in `corners_`; and the ear at each.
    std::vector<std::size_t> left_;
    std::vector<Ear> ears_;
};

/// Projects the corners onto a plane normal to the vector area.
EarClipper::EarClipper(std::span<const Index> corners, const Points& positions)
    : corners_(corners)
    , positions_(positions)
    , ears_(corners.size())
{
    const Point normal = vector_area(corners, positions).stableNormalized();
    const Point x = normal.isZero(0.0) ? Point::UnitX() : normal.unitOrthogonal();
    const Point y = normal.isZero(0.0) ? Point::UnitY() : normal.cross(x);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Point d = positions.row(corners[k]) - positions.row(corners[0]);
        flat_.emplace_back(d.dot(x), d.dot(y));
        left_.push_back(k);
    }
}

/// Whether no remaining corner lies in the triangle or on its border, except corners that coincide with those of the
/// triangle.
bool EarClipper::is_empty(const Point2& a, const Point2& b, const Point2& c) const
{
    return std::ranges::none_of(left_, [&](std::size_t k) {
        const Point2& p = flat_[k];
        return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
}

/// The quality of the ear at k.
Quality EarClipper::quality_of(std::size_t k) const
{
    const Point2& a = flat(before(k));
    const Point2& b = flat(k);
    const Point2& c = flat(after(k));
    const double turning = turn(a, b, c);
    // The largest sine of a turn that may be rounding.
    constexpr double flatness = 1e-12;
    if (std::abs(turning) <= flatness * (b - a).norm() * (c - b).norm())
        return Quality::Flat;
    return turning > 0.0 && is_empty(a, b, c) ? Quality::Clean : Quality::None;
}

/// Sets the ear at k.
void EarClipper::examine(std::size_t k)
{
    const Point diagonal = positions_.row(vertex(before(k))) - positions_.row(vertex(after(k)));
    ears_[k] = {quality_of(k), diagonal.squaredNorm(), vertex(k)};
}

/// Examines ears again after the corner at k has been removed. Removing a clean ear only affects its neighbours; a
/// collinear corner, however, may have been on the diagonal of any other ear.
void EarClipper::examine_around(std::size_t k, Quality quality)
{
    const std::size_t next = k == left_.size() ? 0 : k;
    examine(next);
    examine(before(next));
    for (std::size_t other = 0; quality == Quality::Flat && other < left_.size(); ++other)
        examine(other);
}

/// Cuts off ears until three corners are left, and appends all triangles.
void EarClipper::run(std::vector<Triangle>& triangles)
{
    for (std::size_t k = 0; left_.size() > 3 && k < left_.size(); ++k)
        examine(k);
    while (left_.size() > 3) {
        const auto best = std::ranges::min_element(ears_) - ears_.begin();
        const auto k = static_cast<std::size_t>(best);
        const Quality quality = ears_[k].quality;
        triangles.push_back({vertex(before(k)), vertex(k), vertex(after(k))});
        left_.erase(left_.begin() + best);
        ears_.erase(ears_.begin() + best);
        examine_around(k, quality);
    }
    triangles.push_back({vertex(0), vertex(1), vertex(2)});
}

/// The mean of the corners of a face.
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

void triangulate(std::span<const Index> corners, const Points& positions, std::vector<Triangle>& triangles)
{
    if (corners.size() == 3)
        triangles.push_back({corners[0], corners[1], corners[2]});
    else
        EarClipper(corners, positions).run(triangles);
}

std::vector<Triangle> triangulate(const PolygonMesh& mesh)
{
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.n_corners() - 2 * mesh.n_faces());
    for (Index f = 0; f < mesh.n_faces(); ++f)
        triangulate(mesh.face(f), mesh.vertices, triangles);
    return triangles;
}

CentreFans fans_around_centres(const PolygonMesh& mesh, const Points& positions)
{
    CentreFans fans;
    std::vector<Point> centres;
    std::vector<Triangle> cut;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        const Point centre = centre_of(face, positions);
        if (face.size() > 3 && turns_one_way(face, centre, positions)) {
            const auto number = static_cast<Index>(positions.rows()) + static_cast<Index>(centres.size());
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
