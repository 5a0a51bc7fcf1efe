#include "engine/displacement_meter.h"

#include <cmath>
#include <limits>

#include "engine/parallel_loop.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

DisplacementField undefined_field(Index vertices)
{
    return {.tangential = std::vector<double>(at(vertices), undefined),
            .normal = std::vector<double>(at(vertices), undefined)};
}

/// To a sum that is undefined as long as nothing was added.
void add(double& sum, double value)
{
    sum = std::isnan(sum) ? value : sum + value;
}

}  // namespace

DisplacementMeter::DisplacementMeter(const PolygonMesh& mesh, const Topology& topology)
    : normals_(mesh, topology)
    , normal_(mesh.n_vertices(), 3)
    , drift_(Points::Zero(mesh.n_vertices(), 3))
    , latest_(undefined_field(mesh.n_vertices()))
    , path_(undefined_field(mesh.n_vertices()))
{
    measure_normals(mesh.vertices);
}

void DisplacementMeter::measure_normals(const Points& positions)
{
    for_each(run_in_parallel, static_cast<Index>(positions.rows()),
             [&](Index v) { normal_.row(v) = normals_(v, positions); });
}

DisplacementSums DisplacementMeter::sums() const
{
    return {.drift = drift_, .tangential = path_.tangential, .normal = path_.normal};
}

void DisplacementMeter::restore(const DisplacementSums& sums, const Points& now)
{
    if (sums.drift.rows() != drift_.rows() || sums.tangential.size() != path_.tangential.size() ||
        sums.normal.size() != path_.normal.size())
        throw InputError("the displacements to go on from are not those of this mesh");
    drift_ = sums.drift;
    path_ = {.tangential = sums.tangential, .normal = sums.normal};
    measure_normals(now);
}

DisplacementStatistics DisplacementMeter::add_step(const Points& before, const Points& after)
{
    for_each(run_in_parallel, static_cast<Index>(after.rows()), [&](Index v) {
        const Point normal_after = normals_(v, after);
        const Displacement d = split_displacement(after.row(v) - before.row(v), normal_.row(v), normal_after);
        normal_.row(v) = normal_after;
        drift_.row(v) += d.tangential;
        latest_.tangential[at(v)] = d.defined ? d.tangential.norm() : undefined;
        latest_.normal[at(v)] = d.defined ? d.normal : undefined;
        if (!d.defined)
            return;
        add(path_.tangential[at(v)], latest_.tangential[at(v)]);
        add(path_.normal[at(v)], std::abs(d.normal));
    });
    return displacement_statistics(latest_);
}

TotalDisplacement DisplacementMeter::total() const
{
    std::vector<double> drift = path_.tangential;
    for (std::size_t v = 0; v < drift.size(); ++v)
        if (!std::isnan(drift[v]))
            drift[v] = drift_.row(static_cast<Eigen::Index>(v)).norm();
    return {.path = displacement_statistics(path_), .drift = length_statistics(drift)};
}

}  // namespace seamflow
