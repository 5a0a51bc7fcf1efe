#include "solvers/interface/residual_indicator.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// A row in the making.
struct Draft {
    const Points& before;
    const Points& after;
    Index vertex;
    std::span<const Index> neighbours;
    std::span<double> couplings;
    IndicatorRow row;
    /// Couplings to vertices that share a face but no edge: their sum, and that of their products with squared
    /// distances, across Γ and in all.
    double far = 0.0;
    double far_across = 0.0;
    double far_squares = 0.0;
    /// Unit vector along Γ; zero where it has none.
    Point along = Point::Zero();

    [[nodiscard]] Point to(Index other) const { return before.row(other) - before.row(vertex); }
    [[nodiscard]] double square_across(const Point& difference) const
    {
        const double tangential = difference.dot(along);
        return std::max(0.0, difference.squaredNorm() - tangential * tangential);
    }
};

void add_edges(double time_step, Draft& draft)
{
    double length = 0.0;
    for (std::size_t j = 0; j < draft.neighbours.size(); ++j) {
        const double norm = draft.to(draft.neighbours[j]).norm();
        length += norm;
        draft.couplings[j] = time_step / norm;
        draft.row.residual -=
            draft.couplings[j] * (draft.after.row(draft.neighbours[j]) - draft.after.row(draft.vertex));
    }
    draft.row.mass = length / static_cast<double>(draft.neighbours.size());
}

/// The coupling of the vertex to one of its edge neighbours.
void add_coupling(Index neighbour, double coupling, Draft& draft)
{
    const auto place = std::find(draft.neighbours.begin(), draft.neighbours.end(), neighbour);
    draft.couplings[static_cast<std::size_t>(place - draft.neighbours.begin())] += coupling;
    draft.row.residual -= coupling * (draft.after.row(neighbour) - draft.after.row(draft.vertex));
}

/// A triangle has the cotangents of the angles opposite to its edges, and a third of its area.
void add_triangle(Index next, Index previous, double time_step, Draft& draft)
{
    const Point first = draft.to(next);
    const Point second = draft.to(previous);
    const Point normal = first.cross(second);
    const double double_area = normal.norm();
    const double weight = 0.5 * time_step / double_area;
    draft.row.normal += normal;
    draft.row.mass += double_area / 6.0;
    add_coupling(next, weight * second.dot(second - first), draft);
    add_coupling(previous, weight * first.dot(first - second), draft);
}

void add_face(std::span<const Index> corners, std::size_t own, double time_step, Draft& draft)
{
    const double face_area = area(corners, draft.before);
    draft.row.mass += face_area / static_cast<double>(corners.size());
    const Point bisector = time_step / face_area * corner_bisector(corners, own, draft.before);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (k == own)
            continue;
        const double coupling = -bisector.dot(corner_bisector(corners, k, draft.before));
        draft.row.residual -= coupling * (draft.after.row(corners[k]) - draft.after.row(draft.vertex));
        const auto place = std::find(draft.neighbours.begin(), draft.neighbours.end(), corners[k]);
        if (place != draft.neighbours.end()) {
            draft.couplings[static_cast<std::size_t>(place - draft.neighbours.begin())] += coupling;
        } else {
            const Point difference = draft.to(corners[k]);
            draft.far += coupling;
            draft.far_across += coupling * draft.square_across(difference);
            draft.far_squares += coupling * difference.squaredNorm();
        }
    }
}

/// Calls action(corners, k) for every face of a fan, k being the place of vertex v in it.
template <class Action>
void for_each_face(std::span<const Index> fan, const IndexLists& faces, Index v, Action&& action)
{
    for (const Index f : fan) {
        const auto corners = faces[f];
        action(corners, static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin()));
    }
}

Point unit(const Point& vector)
{
    const double norm = vector.norm();
    return norm > 0.0 ? Point(vector / norm) : Point::Zero();
}

/// How far a disturbance spreads in a step, squared: dt D, D = ΣK d² / 4M. It is dt for a Laplacian that is exact on
/// quadratic functions; obtuse triangles are kept from making it meaningless.
double spread(const Draft& draft, double time_step)
{
    double squares = draft.far_squares;
    for (std::size_t j = 0; j < draft.neighbours.size(); ++j)
        squares += draft.couplings[j] * draft.to(draft.neighbours[j]).squaredNorm();
    return std::clamp(0.25 * squares / draft.row.mass, 0.25 * time_step, 4.0 * time_step);
}

/// Fills in the diagonal, and drops the couplings that are not between vertices of Γ.
void close_row(std::span<const Index> kinds, double spread_squared, Draft& draft)
{
    double held = 0.0;
    double beyond = draft.far;
    double across = draft.far_across;
    for (std::size_t j = 0; j < kinds.size(); ++j) {
        double& coupling = draft.couplings[j];
        if (kinds[j] == off_interface) {
            beyond += coupling;
            across += coupling * draft.square_across(draft.to(draft.neighbours[j]));
        } else {
            held += std::max(coupling, 0.0);
        }
        coupling = kinds[j] >= 0 ? std::max(coupling, 0.0) : 0.0;
    }
    draft.row.diagonal = draft.row.mass + held;
    if (beyond <= 0.0)
        return;
    const double cosh_less_one = 0.5 * std::max(0.0, across / beyond) / spread_squared;
    const double left = 1.0 / (1.0 + cosh_less_one + std::sqrt(cosh_less_one * (cosh_less_one + 2.0)));
    draft.row.yielded = beyond * left;
    draft.row.diagonal += beyond - draft.row.yielded;
}

}  // namespace

bool has_indicator_row(Laplacian laplacian)
{
    return laplacian == Laplacian::Fujiwara || laplacian == Laplacian::AlexaWardetzky ||
           laplacian == Laplacian::PtackovaVelho;
}

IndicatorRow indicator_row(const SubMesh& sub_mesh, Laplacian laplacian, Index i, std::span<const Index> kinds,
                           const Points& before, const Points& after, double time_step, std::span<double> couplings)
{
    const auto& interface = sub_mesh.interface;
    const Index v = interface.vertices[at(i)];
    std::fill(couplings.begin(), couplings.end(), 0.0);
    Draft draft{before, after, v, sub_mesh.seam.neighbours[i], couplings, {}};
    draft.along = unit(before.row(interface.after[at(i)]) - before.row(interface.before[at(i)]));
    if (laplacian == Laplacian::Fujiwara)
        add_edges(time_step, draft);
    const auto visit = [&](std::span<const Index> corners, std::size_t k) {
        const std::size_t p = corners.size();
        const Index next = corners[k + 1 == p ? 0 : k + 1];
        const Index previous = corners[k == 0 ? p - 1 : k - 1];
        if (laplacian != Laplacian::Fujiwara && p == 3)
            return add_triangle(next, previous, time_step, draft);
        if (laplacian != Laplacian::Fujiwara)
            add_face(corners, k, time_step, draft);
        draft.row.normal += draft.to(next).cross(draft.to(previous));
    };
    for_each_face(interface.own_faces[i], sub_mesh.face_vertices, v, visit);
    if (laplacian != Laplacian::Fujiwara)
        for_each_face(interface.complement_faces[i], interface.halo_faces, v, visit);
    draft.row.normal = unit(draft.row.normal);
    draft.row.residual += draft.row.mass * (after.row(v) - before.row(v));
    close_row(kinds, spread(draft, time_step), draft);
    return draft.row;
}

}  // namespace seamflow
