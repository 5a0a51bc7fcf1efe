#include "engine/drift_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "solvers/interface/ptackova_residual.h"
#include "solvers/interface/residual_indicator.h"

namespace seamflow {

namespace {

/// How many vertices of Γ are taken together: what they add up to depends on their number alone.
constexpr Index block = 1024;

/// Runs body(number, begin, end) for each block.
template <class Body>
void for_each_part(const Loop& loop, Index n, Body&& body)
{
    for_each(loop, (n + block - 1) / block,
             [&](Index number) { body(number, number * block, std::min(n, (number + 1) * block)); });
}

}  // namespace

DriftEstimate::DriftEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                             double time_step)
    : decomposition_(&decomposition)
    , laplacian_(laplacian)
    , time_step_(time_step)
    , first_{0}
{
    std::vector<Index> kind(topology.kind.size());
    std::transform(topology.kind.begin(), topology.kind.end(), kind.begin(),
                   [](VertexKind k) { return k == VertexKind::Interior ? off_interface : held_fixed; });
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const auto& vertices = sub_mesh.interface.vertices;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (sub_mesh.owned[at(vertices[i])] != 0) {
                kind[at(sub_mesh.local_to_global[at(vertices[i])])] = static_cast<Index>(index_in_owner_.size());
                index_in_owner_.push_back(static_cast<Index>(i));
            }
        first_.push_back(static_cast<Index>(index_in_owner_.size()));
    }
    for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
        const SubMesh& sub_mesh = decomposition.sub_meshes[s];
        for (Index n = first_[s]; n < first_[s + 1]; ++n) {
            for (const Index neighbour : sub_mesh.seam.neighbours[index_in_owner_[at(n)]])
                neighbours_.values.push_back(kind[at(sub_mesh.local_to_global[at(neighbour)])]);
            neighbours_.close();
        }
    }
    if (laplacian == Laplacian::PtackovaVelho)
        list_surroundings(mesh, topology, kind);
    couplings_.resize(neighbours_.values.size());
    mass_.resize(index_in_owner_.size());
    diagonal_.resize(index_in_owner_.size());
    yielded_.resize(index_in_owner_.size());
    of_block_.resize(index_in_owner_.size() / static_cast<std::size_t>(block) + 1);
    for (Points* array : {&normal_, &residual_, &error_, &direction_, &product_, &swept_, &corrected_})
        array->setZero(size(), 3);
}

void DriftEstimate::list_surroundings(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> kind)
{
    std::vector<Index> number(kind.size(), -1);
    vertices_.resize(index_in_owner_.size());
    for (std::size_t v = 0; v < kind.size(); ++v)
        if (kind[v] >= 0)
            vertices_[at(kind[v])] = static_cast<Index>(v);
    std::vector<Index> around;
    for (const Index v : vertices_) {
        around.clear();
        for (const Index corner : topology.corners_at(v))
            for (const Index w : mesh.face(topology.face_of[at(corner)]))
                if (kind[at(w)] == off_interface)
                    around.push_back(w);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const Index w : around) {
            if (number[at(w)] < 0) {
                number[at(w)] = static_cast<Index>(surroundings_.size());
                surroundings_.push_back(w);
                n_shared_.push_back(0);
            }
            ++n_shared_[at(number[at(w)])];
            around_.values.push_back(number[at(w)]);
        }
        around_.close();
    }
    residual_around_.resize(static_cast<Eigen::Index>(surroundings_.size()), 3);
}

/// What rows beside Γ leave is shared out to the vertices of Γ.
void DriftEstimate::measure_around(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                                   const Points& after, const Loop& loop)
{
    for_each_part(loop, static_cast<Index>(surroundings_.size()), [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            residual_around_.row(i) =
                ptackova_residual(mesh, topology, before, after, time_step_, surroundings_[at(i)]) / n_shared_[at(i)];
    });
    for_each_part(loop, size(), [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            residual_.row(i) = ptackova_residual(mesh, topology, before, after, time_step_, vertices_[at(i)]);
            for (const Index w : around_[i])
                residual_.row(i) += residual_around_.row(w);
        }
    });
}

void DriftEstimate::measure(Index s, const SubMeshState& state)
{
    for (Index n = first_[at(s)]; n < first_[at(s) + 1]; ++n) {
        const Index begin = neighbours_.offsets[at(n)];
        const IndicatorRow row =
            indicator_row(*state.sub_mesh, laplacian_, index_in_owner_[at(n)], neighbours_[n], state.position,
                          state.solved, time_step_, std::span(couplings_).subspan(at(begin), neighbours_[n].size()));
        mass_[at(n)] = row.mass;
        diagonal_[at(n)] = row.diagonal;
        const auto kinds = neighbours_[n];
        const auto along = std::count_if(kinds.begin(), kinds.end(), [](Index kind) { return kind >= 0; });
        yielded_[at(n)] = row.yielded / static_cast<double>(std::max<std::ptrdiff_t>(along, 1));
        normal_.row(n) = row.normal;
        residual_.row(n) = row.residual;
        error_.row(n).setZero();
    }
}

void DriftEstimate::note_correction(Index s, const SubMeshState& state)
{
    const auto& vertices = state.sub_mesh->interface.vertices;
    for (Index n = first_[at(s)]; n < first_[at(s) + 1]; ++n) {
        const Index v = vertices[at(index_in_owner_[at(n)])];
        error_.row(n) = state.position.row(v) - state.solved.row(v);
    }
}

template <class Value>
double DriftEstimate::add_up(const Loop& loop, Value&& value)
{
    for_each_part(loop, size(), [&](Index number, Index begin, Index end) {
        double total = 0.0;
        for (Index i = begin; i < end; ++i)
            total += value(i);
        of_block_[at(number)] = total;
    });
    double total = 0.0;
    for (Index number = 0; number < (size() + block - 1) / block; ++number)
        total += of_block_[at(number)];
    return total;
}

/// T times the direction.
Point DriftEstimate::product(Index i) const
{
    Point sum = diagonal_[at(i)] * direction_.row(i);
    for (Index e = neighbours_.offsets[at(i)]; e < neighbours_.offsets[at(i) + 1]; ++e)
        if (neighbours_.values[at(e)] >= 0)
            sum -= couplings_[at(e)] * direction_.row(neighbours_.values[at(e)]);
    return sum;
}

/// Conjugate gradients, x, y and z as one system, preconditioned by the diagonal. The error needs few digits.
void DriftEstimate::solve(const Loop& loop)
{
    constexpr int most_iterations = 30;
    constexpr double tolerance = 1e-4;
    error_.setZero();
    double before = add_up(loop, [&](Index i) {
        direction_.row(i) = residual_.row(i) / diagonal_[at(i)];
        return residual_.row(i).dot(direction_.row(i));
    });
    const double enough = tolerance * before;
    for (int iteration = 0; iteration < most_iterations && before > enough; ++iteration) {
        const double curvature = add_up(loop, [&](Index i) {
            product_.row(i) = product(i);
            return product_.row(i).dot(direction_.row(i));
        });
        const double length = before / curvature;
        const double now = add_up(loop, [&](Index i) {
            error_.row(i) += length * direction_.row(i);
            residual_.row(i) -= length * product_.row(i);
            return residual_.row(i).squaredNorm() / diagonal_[at(i)];
        });
        for_each_part(loop, size(), [&](Index, Index begin, Index end) {
            for (Index i = begin; i < end; ++i)
                direction_.row(i) = residual_.row(i) / diagonal_[at(i)] + now / before * direction_.row(i);
        });
        before = now;
    }
}

void DriftEstimate::stiffen(const Loop& loop)
{
    constexpr double share = 0.75;
    for_each_part(loop, size(), [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            for (Index e = neighbours_.offsets[at(i)]; e < neighbours_.offsets[at(i) + 1]; ++e)
                if (const Index other = neighbours_.values[at(e)]; other >= 0) {
                    const double stiffness = share * std::min(yielded_[at(i)], yielded_[at(other)]);
                    couplings_[at(e)] += stiffness;
                    diagonal_[at(i)] += stiffness;
                }
    });
}

void DriftEstimate::carry_over(const Loop& loop)
{
    const double keep_t = laplacian_ == Laplacian::Fujiwara ? 0.5 : 1.0;
    for_each_part(loop, size(), [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Point correction = error_.row(i);
            const Point normal = normal_.row(i);
            const Point c = corrected_.row(i);
            const Point cn = c.dot(normal) * normal;
            const Point kept = keep_t * (c - cn);
            residual_.row(i) += mass_[at(i)] * (c - kept);
            corrected_.row(i) = kept + correction;
            const Point f = swept_.row(i);
            const Point fn = f.dot(normal) * normal;
            swept_.row(i) = (0.5 + 0.5 * keep_t) * (f - fn) + 0.7 * fn;
        }
    });
}

void DriftEstimate::add_step(const Loop& loop)
{
    carry_over(loop);
    stiffen(loop);
    solve(loop);
    for_each_part(loop, size(), [&](Index number, Index begin, Index end) {
        double largest = 0.0;
        for (Index i = begin; i < end; ++i) {
            swept_.row(i) += error_.row(i);
            largest = std::max({largest, swept_.row(i).norm(), (swept_.row(i) + corrected_.row(i)).norm()});
        }
        of_block_[at(number)] = largest;
    });
    largest_ = 0.0;
    for (Index number = 0; number < (size() + block - 1) / block; ++number)
        largest_ = std::max(largest_, of_block_[at(number)]);
    if (std::getenv("SFD")) {
        double a = 0, b = 0, c = 0, d = 0;
        for (Index i = 0; i < size(); ++i) {
            a = std::max(a, error_.row(i).norm());
            b = std::max(b, corrected_.row(i).norm());
            c = std::max(c, swept_.row(i).norm());
            d = std::max(d, (swept_.row(i) + corrected_.row(i)).norm());
        }
        std::fprintf(stderr, "SFD e %g corr %g swept %g all %g\n", a, b, c, d);
    }
}

}  // namespace seamflow
