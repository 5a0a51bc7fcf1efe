#include "solvers/estimate/error_row.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// A row under construction.
struct Draft {
    const Points& before;
    const Points& after;
    const Points& stiffness_at;
    Index vertex;
    std::span<const Index> neighbours;
    std::span<double> couplings;
    ErrorRow row;
    /// Over the couplings to vertices that share a face but no edge with v: their sum; the sum of their products with
    /// squared distances across Γ; and the sum of their products with squared distances.
    double far = 0.0;
    double far_across = 0.0;
    double far_squares = 0.0;
    /// The unit vector along Γ; zero where Γ has no direction.
    Point along = Point::Zero();

    [[nodiscard]] Point to(Index other) const { return before.row(other) - before.row(vertex); }
    [[nodiscard]] bool keeps_stiffness() const { return &stiffness_at != &before; }
    /// The square of the component of a vector across Γ.
    [[nodiscard]] double square_across(const Point& difference) const
    {
        const double tangential = difference.dot(along);
        return std::max(0.0, difference.squaredNorm() - tangential * tangential);
    }
};

/// Adds the rows of the edges at the vertex to the residual, to the couplings and to M.
template <EdgeKernel Kernel>
void add_edges(Kernel kernel, double time_step, Draft& draft)
{
    double sum = 0.0;
    for (std::size_t j = 0; j < draft.neighbours.size(); ++j) {
        const auto edge = kernel.edge(draft.to(draft.neighbours[j]));
        sum += edge.mass();
        draft.couplings[j] = edge.weight(time_step);
        if (draft.keeps_stiffness())
            draft.couplings[j] =
                kernel.edge(draft.stiffness_at.row(draft.neighbours[j]) - draft.stiffness_at.row(draft.vertex))
                    .weight(time_step);
        draft.row.residual -=
            draft.couplings[j] * (draft.after.row(draft.neighbours[j]) - draft.after.row(draft.vertex));
    }
    draft.row.mass = Kernel::averages_mass ? sum / static_cast<double>(draft.neighbours.size()) : sum;
}

/// Adds the coupling of the vertex to another corner of one of its faces.
void add_coupling(Index other, double coupling, Draft& draft)
{
    draft.row.residual -= coupling * (draft.after.row(other) - draft.after.row(draft.vertex));
    const auto found = std::find(draft.neighbours.begin(), draft.neighbours.end(), other);
    if (found != draft.neighbours.end()) {
        draft.couplings[static_cast<std::size_t>(found - draft.neighbours.begin())] += coupling;
        return;
    }
    const Point difference = draft.to(other);
    draft.far += coupling;
    draft.far_across += coupling * draft.square_across(difference);
    draft.far_squares += coupling * difference.squaredNorm();
}

/// Adds the row of one face at its corner `own`, the vertex.
template <FaceKernel Kernel>
void add_face(std::span<const Index> corners, std::size_t own, double time_step, Draft& draft)
{
    if (draft.keeps_stiffness())
        draft.row.mass += Kernel::corner_mass(Kernel::size(corners, draft.before), corners.size());
    measure_corner<Kernel>(corners, own, draft.stiffness_at, [&](const auto& face, std::size_t i) {
        draft.row.mass += draft.keeps_stiffness() ? 0.0 : face.mass(i);
        const auto row = face.row(i, time_step / face.divisor());
        for (std::size_t k = 0; k < face.size(); ++k)
            if (k != i)
                add_coupling(face.corner(k), -row(k), draft);
    });
}

/// Calls action(corners, k) for every face of a fan, k being the index of vertex v among the corners.
template <class Action>
void for_each_face(std::span<const Index> fan, const IndexLists& faces, Index v, Action&& action)
{
    for (const Index f : fan) {
        const auto corners = faces[f];
        action(corners, static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin()));
    }
}

/// The squared distance over which a disturbance spreads in a step: dt D, D = Σ k d² / (4 M) over the other vertices of
/// the row, with k = -K and d their distances. D is 1 for a Laplacian that is exact on quadratic functions. It is
/// clamped, because obtuse triangles can make it meaningless.
double squared_spread(const Draft& draft, double time_step)
{
    double squares = draft.far_squares;
    for (std::size_t j = 0; j < draft.neighbours.size(); ++j)
        squares += draft.couplings[j] * draft.to(draft.neighbours[j]).squaredNorm();
    return std::clamp(0.25 * squares / draft.row.mass, 0.25 * time_step, 4.0 * time_step);
}

/// Computes the diagonal and the response, and drops the couplings to vertices that are not on Γ.
/// @param kinds one per edge neighbour: its number on Γ, off_interface or fixed_vertex. @param spread_squared dt D, in
/// length².
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
    // cosh θ - 1, with the mean squared distance across Γ of the vertices beyond it; and e^-θ.
    const double cosh_less_one = 0.5 * std::max(0.0, across / beyond) / spread_squared;
    const double left = 1.0 / (1.0 + cosh_less_one + std::sqrt(cosh_less_one * (cosh_less_one + 2.0)));
    draft.row.response = beyond * left;
    draft.row.diagonal += beyond - draft.row.response;
}

/// The Laplacian whose T is used: Δ_A for Laplacians that reach two rings, and otherwise the Laplacian itself.
template <class Kernel>
using WithinOneRing = std::conditional_t<Kernel::traits.reach == Reach::TwoRings, AlexaWardetzky, Kernel>;

}  // namespace

ErrorRow error_row(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, Index i,
                   std::span<const std::int8_t> senses, std::span<const Index> kinds, const SolvedStep& step,
                   std::span<double> couplings)
{
    const Points& before = step.before;
    const Points& after = step.after;
    const auto& interface = sub_mesh.interface;
    const Index v = interface.vertices[i];
    std::fill(couplings.begin(), couplings.end(), 0.0);
    Draft draft{before, after, step.stiffness_at, v, sub_mesh.corrected.neighbours[i], couplings, {}};
    draft.along = unit_or_zero(before.row(interface.after[i]) - before.row(interface.before[i]));
    std::size_t n_faces = 0;
    with_kernel(laplacian, [&]<class Given>(Given given) {
        using Kernel = WithinOneRing<Given>;
        const auto visit = [&](std::span<const Index> corners, std::size_t k) {
            if constexpr (FaceKernel<Kernel>)
                add_face<Kernel>(corners, k, step.time_step, draft);
            const std::size_t p = corners.size();
            const Index next = corners[k + 1 == p ? 0 : k + 1];
            const Index previous = corners[k == 0 ? p - 1 : k - 1];
            const int sense = senses.empty() ? 1 : senses[n_faces];
            draft.row.normal += sense * draft.to(next).cross(draft.to(previous));
            ++n_faces;
        };
        for_each_face(interface.own_faces[i], sub_mesh.face_vertices, v, visit);
        if constexpr (FaceKernel<Kernel>)
            for_each_face(interface.complement_faces[i], interface.halo_faces, v, visit);
        else
            add_edges(given, step.time_step, draft);
    });
    draft.row.normal = unit_or_zero(draft.row.normal);
    draft.row.residual += draft.row.mass * (after.row(v) - before.row(v));
    close_row(kinds, squared_spread(draft, step.time_step), draft);
    return draft.row;
}

}  // namespace seamflow
