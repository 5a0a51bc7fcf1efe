#include "solvers/systems/whole_mesh_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "partition/errors.h"
#include "partition/index_lists.h"
#include "solvers/krylov/sums.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// The rows of K at certain positions.
struct RowGeometry {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& positions;
    std::span<const Index> offsets;
    std::span<const Index> columns;

    [[nodiscard]] std::span<const Index> neighbours(Index v) const
    {
        return columns.subspan(offsets[v], offsets[v + 1] - offsets[v]);
    }
};

/// Calls entry(place, K_vw) with the place of w among the neighbours of v, maybe several times for one w; the rows of K
/// add up to zero.
/// @returns M_v.
template <EdgeKernel Kernel, class Entry>
double visit_row(const RowGeometry& g, Index v, Entry&& entry)
{
    const Point here = g.positions.row(v);
    const std::span<const Index> neighbours = g.neighbours(v);
    double mass = 0.0;
    if (g.topology.kind[v] != VertexKind::Boundary) {
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            const typename Kernel::Edge edge(here - g.positions.row(neighbours[i]));
            entry(i, -edge.weight(1.0));
            mass += edge.mass();
        }
        return mass / static_cast<double>(neighbours.size());
    }
    // Each half-edge is half of its edge.
    const std::span<const Index> corners = g.topology.corners_at(v);
    for (const Index corner : corners)
        for (const Index end : {g.topology.next(g.mesh, corner), g.topology.previous(g.mesh, corner)}) {
            const Index w = g.mesh.face_vertices[end];
            const typename Kernel::Edge edge(here - g.positions.row(w));
            entry(std::find(neighbours.begin(), neighbours.end(), w) - neighbours.begin(), -edge.weight(0.5));
            mass += edge.mass();
        }
    return mass / static_cast<double>(2 * corners.size());
}

template <FaceKernel Kernel, class Entry>
double visit_row(const RowGeometry& g, Index v, Entry&& entry)
{
    const std::span<const Index> neighbours = g.neighbours(v);
    double mass = 0.0;
    for (const Index corner : g.topology.corners_at(v)) {
        const Index f = g.topology.face_of[corner];
        measure_corner<Kernel>(
            g.mesh.face(f), at(corner - g.mesh.face_offsets[f]), g.positions, [&](const auto& face, std::size_t i) {
                const auto row = face.row(i, 1.0 / face.divisor());
                for (std::size_t k = 0; k < face.size(); ++k)
                    if (k != i)
                        entry(std::lower_bound(neighbours.begin(), neighbours.end(), face.corner(k)) -
                                  neighbours.begin(),
                              row(k));
                mass += face.mass(i);
            });
    }
    return mass;
}

/// Calls action(visit), where visit(v, entry) is visit_row of the Laplacian.
template <class Action>
void with_rows(Laplacian laplacian, const RowGeometry& geometry, Action&& action)
{
    with_kernel(laplacian, [&]<class Kernel>(Kernel) {
        if constexpr (EdgeKernel<Kernel> || FaceKernel<Kernel>)
            action([&](Index v, auto&& entry) { return visit_row<Kernel>(geometry, v, entry); });
        else
            throw OptionError("the Laplacian is not symmetric");
    });
}

/// Finds the other vertices in the rows of a matrix, ascending.
class RowPattern {
  public:
    RowPattern(const PolygonMesh& mesh, const Topology& topology, Reach reach)
        : mesh_(&mesh)
        , topology_(&topology)
        , along_edges_(reach == Reach::Edges || mesh.n_corners() == 3 * mesh.n_faces())
    {
    }

    [[nodiscard]] Index count(Index v)
    {
        if (next_are_all(v))
            return static_cast<Index>(topology_->corners_at(v).size());
        list(v);
        return static_cast<Index>(neighbours_.size());
    }

    /// Those of v, until the next call.
    const std::vector<Index>& list(Index v)
    {
        neighbours_.clear();
        for (const Index corner : topology_->corners_at(v)) {
            if (along_edges_) {
                add(topology_->next(*mesh_, corner));
                if (!next_are_all(v))
                    add(topology_->previous(*mesh_, corner));
                continue;
            }
            const auto face = mesh_->face(topology_->face_of[corner]);
            neighbours_.insert(neighbours_.end(), face.begin(), face.end());
        }
        sort_unique(neighbours_);
        std::erase(neighbours_, v);
        return neighbours_;
    }

  private:
    /// Whether the vertices after v in its faces are all that share edges with it, each met once.
    [[nodiscard]] bool next_are_all(Index v) const
    {
        return along_edges_ && topology_->oriented && topology_->kind[v] == VertexKind::Interior;
    }

    void add(Index corner) { neighbours_.push_back(mesh_->face_vertices[corner]); }

    const PolygonMesh* mesh_;
    const Topology* topology_;
    bool along_edges_;
    std::vector<Index> neighbours_;
};

/// Single precision is good for so much in one go; what may be left of a residual then without it being too little
/// progress.
constexpr double most_reduction_at_once = 1e-4;
constexpr double most_left = 0.5;
/// Passes that leave more of the residual say little of the rate at which updates become smaller.
constexpr double shortest_pass = 0.1;

Eigen::Array4f to_row(const Point& point)
{
    return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]), 0.0F};
}

/// Where the denominator is not positive, 0.
Eigen::Array4f quotients(const Eigen::Array4d& numerators, const Eigen::Array4d& denominators)
{
    return (denominators > 0.0).select(numerators / denominators, 0.0).cast<float>();
}

}  // namespace

WholeMeshSystem::WholeMeshSystem(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                 const Loop& loop)
    : mesh_(&mesh)
    , topology_(&topology)
    , laplacian_(laplacian)
    , offsets_(at(mesh.n_vertices()) + 1, 0)
    , diagonal_(mesh.n_vertices(), 1.0F)
{
    for (Rows* rows : {&iterates_.residual, &iterates_.direction, &iterates_.product, &iterates_.increment})
        rows->assign(mesh.n_vertices(), Row::Zero());
    const Reach reach = traits_of(laplacian).reach;
    for (const bool fill : {false, true}) {
        for_each_block(loop, mesh.n_vertices(), [&](Index, Index begin, Index end) {
            RowPattern pattern(mesh, topology, reach);
            for (Index v = begin; v < end; ++v) {
                if (!topology.moves(v))
                    continue;
                if (fill)
                    std::ranges::copy(pattern.list(v), columns_.begin() + offsets_[v]);
                else
                    offsets_[v + 1] = pattern.count(v);
            }
        });
        if (fill)
            break;
        if (std::accumulate(offsets_.begin(), offsets_.end(), std::int64_t{0}) > std::numeric_limits<Index>::max())
            throw ComputationError("the equations of the whole mesh have more than 2147483647 coefficients: take "
                                   "sub-meshes instead of conjugate gradients");
        std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
        columns_.resize(offsets_.back());
        values_.resize(offsets_.back());
    }
}

/// The matrix, and the residual of Vᵏ⁺¹ = Vᵏ.
/// @returns of each column, the squared norm of what of the residual may be rounding.
Eigen::Array4d WholeMeshSystem::assemble(const Points& before, const Loop& loop)
{
    const RowGeometry geometry{*mesh_, *topology_, before, offsets_, columns_};
    Eigen::Array4d squared_sizes;
    with_rows(laplacian_, geometry, [&](auto&& visit) {
        squared_sizes = sum_of<Eigen::Array4d>(loop, mesh_->n_vertices(), [&](Index v) -> Eigen::Array4d {
            if (!topology_->moves(v))
                return Eigen::Array4d::Zero();
            float* const values = values_.data() + offsets_[v];
            const Index* const columns = columns_.data() + offsets_[v];
            std::fill(values, values_.data() + offsets_[v + 1], 0.0F);
            double diagonal = 0.0;
            Eigen::Array4d size = Eigen::Array4d::Zero();
            Point residual = Point::Zero();
            const double mass = visit(v, [&](std::ptrdiff_t i, double k) {
                const double entry = units_.stiffness * k;
                const Point share = entry * (before.row(columns[i]) - before.row(v));
                values[i] += static_cast<float>(entry);
                diagonal -= entry;
                residual -= share;
                size.head<3>() += share.array().abs().transpose();
            });
            diagonal_[v] = static_cast<float>(units_.mass * mass + diagonal);
            iterates_.residual[v] = to_row(units_.length * residual);
            return size.square() / (units_.mass * mass + diagonal);
        });
    });
    const double unit = 4.0 * std::numeric_limits<double>::epsilon() * units_.length;
    return unit * unit * squared_sizes;
}

/// product = A direction.
/// @returns the inner products of the two.
Eigen::Array4d WholeMeshSystem::multiply(const Loop& loop)
{
    return sum_of<Eigen::Array4d>(loop, mesh_->n_vertices(), [&](Index v) -> Eigen::Array4d {
        const Row& p = iterates_.direction[v];
        Row q = diagonal_[v] * p;
        for (Index i = offsets_[v]; i < offsets_[v + 1]; ++i)
            q += values_[i] * iterates_.direction[columns_[i]];
        iterates_.product[v] = q;
        return (p * q).cast<double>();
    });
}

/// residual = -dt K V' - M (V' - V) of the positions V' after the step so far, the weights being those of V.
void WholeMeshSystem::measure(const Points& before, const Points& after, const Loop& loop)
{
    const RowGeometry geometry{*mesh_, *topology_, before, offsets_, columns_};
    with_rows(laplacian_, geometry, [&](auto&& visit) {
        for_each_block(loop, mesh_->n_vertices(), [&](Index, Index begin, Index end) {
            for (Index v = begin; v < end; ++v) {
                if (!topology_->moves(v))
                    continue;
                const Index* const columns = columns_.data() + offsets_[v];
                Point residual = Point::Zero();
                const double mass = visit(v, [&](std::ptrdiff_t i, double k) {
                    residual -= units_.stiffness * k * (after.row(columns[i]) - after.row(v));
                });
                residual -= units_.mass * mass * (after.row(v) - before.row(v));
                iterates_.residual[v] = to_row(units_.length * residual);
            }
        });
    });
}

/// Σ r² / a of each column, a being the diagonal: in double precision, as a small residual has squares that are none in
/// single precision.
Eigen::Array4d WholeMeshSystem::squared_residual(const Loop& loop) const
{
    return sum_of<Eigen::Array4d>(loop, mesh_->n_vertices(), [&](Index v) -> Eigen::Array4d {
        return iterates_.residual[v].cast<double>().square() / static_cast<double>(diagonal_[v]);
    });
}

/// Conjugate gradients (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 9.1) for A increment =
/// residual, preconditioned by the diagonal.
/// @param goal the part of the residual that may be left.
WholeMeshSystem::Pass WholeMeshSystem::iterate(double goal, int most_iterations, const Loop& loop)
{
    const Index n = mesh_->n_vertices();
    Eigen::Array4d squared = squared_residual(loop);
    // Makes the residual about 1 at each vertex.
    Pass result;
    result.scale = std::exp2(-std::ilogb(std::sqrt(squared.sum() / n)));
    const auto scale = static_cast<float>(result.scale);
    squared *= result.scale * result.scale;
    const double first = squared.sum();
    for_each(loop, n, [&](Index v) {
        iterates_.residual[v] *= scale;
        iterates_.direction[v] = iterates_.residual[v] / diagonal_[v];
        iterates_.increment[v].setZero();
    });
    result.residual = 1.0;
    while (result.iterations < most_iterations && result.residual > goal) {
        const Row alpha = quotients(squared, multiply(loop));
        const Eigen::Array4d squared_before = squared;
        squared = sum_of<Eigen::Array4d>(loop, n, [&](Index v) -> Eigen::Array4d {
            Row& r = iterates_.residual[v];
            r -= alpha * iterates_.product[v];
            return (r * r / diagonal_[v]).cast<double>();
        });
        const Row beta = quotients(squared, squared_before);
        ++result.iterations;
        result.residual = std::sqrt(squared.sum() / first);
        std::vector<float> farthest(at(n / block_size) + 1, 0.0F);
        for_each_block(loop, n, [&](Index block, Index begin, Index end) {
            for (Index v = begin; v < end; ++v) {
                Row& p = iterates_.direction[v];
                const Row change = alpha * p;
                farthest[block] = std::max(farthest[block], change.square().sum());
                iterates_.increment[v] += change;
                p = iterates_.residual[v] / diagonal_[v] + beta * p;
            }
        });
        result.last_update = std::sqrt(*std::max_element(farthest.begin(), farthest.end()));
    }
    return result;
}

/// The updates that would follow, if they became smaller at the rate that they have had, summed up.
double WholeMeshSystem::distance_after(const Pass& pass)
{
    const double rate = std::pow(pass.residual, 1.0 / pass.iterations);
    return rate < 1.0 ? pass.last_update * rate / (1.0 - rate) : pass.last_update;
}

WholeMeshSystem::Result WholeMeshSystem::step(const Points& before, double time_step, const IterationStop& stop,
                                              Points& after, const Loop& loop)
{
    const double root = std::sqrt(time_step);
    const double mass_unit = traits_of(laplacian_).divisor == Divisor::EdgeLengths ? root : time_step;
    units_ = {.stiffness = time_step / mass_unit, .mass = 1.0 / mass_unit, .length = 1.0 / root};
    const Eigen::Array4d rounding = assemble(before, loop);
    const Eigen::Array4d squared = squared_residual(loop);
    copy(loop, before, after);
    // There is nothing to smooth.
    if ((squared <= rounding).all())
        return {};
    const double first = std::sqrt(squared.sum());
    StoppingCriterion criterion(stop, most_left, 1.0);
    double left = 1.0;
    double distance = 0.0;
    while (!criterion.is_met()) {
        const Pass pass =
            iterate(std::max(stop.tolerance / left, most_reduction_at_once), criterion.iterations_left(), loop);
        const double length = root / pass.scale;
        for_each(loop, mesh_->n_vertices(), [&](Index v) {
            after.row(v) += length * iterates_.increment[v].head<3>().cast<double>().matrix().transpose();
        });
        const double before_pass = std::exchange(left, left * pass.residual);
        // What the first pass leaves is known well enough; later ones begin near what rounding leaves.
        const bool is_first = before_pass == 1.0;
        if (!is_first || left > stop.tolerance || pass.residual <= most_reduction_at_once) {
            measure(before, after, loop);
            left = std::sqrt(squared_residual(loop).sum()) / first;
        }
        distance = pass.residual > shortest_pass && distance > 0.0
                       ? distance * left / before_pass
                       : length * distance_after(pass) * left / (before_pass * pass.residual);
        criterion.note(pass.iterations, left, left / before_pass);
    }
    return {criterion.result(left), distance};
}

}  // namespace seamflow
