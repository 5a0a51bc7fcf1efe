#include "engine/measure/displacement_meter.h"

#include <cmath>
#include <functional>
#include <limits>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Adds to a sum that is undefined (NaN) until something is added.
void add(double& sum, double value)
{
    sum = std::isnan(sum) ? value : sum + value;
}

}  // namespace

DisplacementMeter::DisplacementMeter(const PolygonMesh& mesh, const Topology& topology)
    : mesh_(mesh)
    , normals_(mesh, topology)
{
}

/// Sets the sums to those of a mesh in which no vertex has moved.
void DisplacementMeter::begin(const Points& positions)
{
    const auto n = static_cast<std::size_t>(positions.rows());
    const std::function<void()> fills[] = {
        [&] { drift_ = Points::Zero(positions.rows(), 3); },
        [&] { path_.tangential.assign(n, undefined); },
        [&] { path_.normal.assign(n, undefined); },
    };
    for_each(run_in_parallel, 3, [&](Index i) { fills[i](); });
    measure_normals(positions);
}

void DisplacementMeter::measure_normals(const Points& positions)
{
    normal_.resize(positions.rows(), 3);
    for_each(run_in_parallel, static_cast<Index>(positions.rows()),
             [&](Index v) { normal_.row(v) = normals_(v, positions); });
}

DisplacementSums DisplacementMeter::sums() const
{
    return {.drift = drift_, .tangential = path_.tangential, .normal = path_.normal};
}

void DisplacementMeter::restore(const DisplacementSums& sums, const Points& now)
{
    const std::size_t n = usize(mesh_.n_vertices());
    if (sums.drift.rows() != mesh_.n_vertices() || sums.tangential.size() != n || sums.normal.size() != n)
        throw InputError("the displacements to resume from are not those of this mesh");
    drift_ = sums.drift;
    path_ = {.tangential = sums.tangential, .normal = sums.normal};
    measure_normals(now);
}

DisplacementStatistics DisplacementMeter::add_step(const Points& before, const Points& after)
{
    struct Sums {
        LengthSums tangential;
        LengthSums normal;
    };
    if (normal_.rows() == 0)
        begin(before);
    const auto n = static_cast<Index>(after.rows());
    const auto measure_vertex = [&](Sums& sums, Index v) {
        const Point normal_after = normals_(v, after);
        const Displacement d = split_displacement(after.row(v) - before.row(v), normal_.row(v), normal_after);
        normal_.row(v) = normal_after;
        drift_.row(v) += d.tangential;
        if (!d.defined)
            return;
        const double tangential = d.tangential.norm();
        add(path_.tangential[v], tangential);
        add(path_.normal[v], std::abs(d.normal));
        sums.tangential.add(tangential);
        sums.normal.add(d.normal);
    };
    const Sums all = reduce(run_in_parallel, n, Sums{}, measure_vertex, [](Sums& total, const Sums& part) {
        total.tangential.add(part.tangential);
        total.normal.add(part.normal);
    });
    return {.tangential = all.tangential.statistics(), .normal = all.normal.statistics()};
}

TotalDisplacement DisplacementMeter::total() const
{
    LengthSums drift;
    for (std::size_t v = 0; v < path_.tangential.size(); ++v)
        if (!std::isnan(path_.tangential[v]))
            drift.add(drift_.row(static_cast<Eigen::Index>(v)).norm());
    return {.path = displacement_statistics(path_), .drift = drift.statistics()};
}

}  // namespace seamflow
