#include "solvers/rounding/normals_in_boxes.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace seamflow {

namespace {

/// The chord of unit normals over which normals on the same side of an edge are averaged.
constexpr float same_side = 0.3F;
/// The rounds in a group, and those of averaging and of fitting in each.
constexpr int most_groups = 4;
constexpr int rounds_of_group = 2;
constexpr int averaging_rounds = 6;
constexpr int fitting_rounds = 7;
/// A group is the last if it has taken less than this fraction of the bending.
constexpr double least_gain = 0.002;

double total_bending(const std::vector<double>& of_parts)
{
    return std::accumulate(of_parts.begin(), of_parts.end(), 0.0);
}

}  // namespace

NormalsInBoxes::NormalsInBoxes(const PolygonMesh& mesh, const Topology& topology, const SurfaceParts& parts,
                               const KeptVolumes& volumes, const Boxes& boxes, const Executor& exec)
    : mesh_(mesh)
    , topology_(topology)
    , parts_(parts)
    , volumes_(volumes)
    , boxes_(boxes)
    , exec_(exec)
    , averages_(mesh, topology, exec, Sheets::Own)
{
}

std::vector<double> NormalsInBoxes::smooth(NormalNeighbours neighbours, Points& positions,
                                           const std::vector<double>& to_beat)
{
    std::vector<double> least = bending(positions);
    for (int group = 0; group < most_groups; ++group) {
        Points further = positions;
        // Weights change little within a group.
        averages_.measure(further, exec_);
        for (int round = 0; round < rounds_of_group; ++round)
            smooth_once(neighbours, further);
        std::vector<double> of_further = bending(further);
        // The first group may bend a surface more that is to become one with edges.
        const double gain = total_bending(least) - total_bending(of_further);
        if (group > 0 && !(gain > 0.0))
            break;
        least = std::move(of_further);
        positions = std::move(further);
        if (group > 0 && gain < least_gain * total_bending(least))
            break;
        if (group == 0 && !to_beat.empty() && std::ranges::equal(least, to_beat, std::ranges::greater_equal()))
            break;
    }
    return least;
}

void NormalsInBoxes::smooth_once(NormalNeighbours neighbours, Points& positions)
{
    averages_.measure_normals(positions, normals_, exec_);
    average_normals(neighbours);
    fit(positions);
    volumes_.restore(boxes_, positions, exec_);
}

void NormalsInBoxes::average_normals(NormalNeighbours neighbours)
{
    for (int round = 0; round < averaging_rounds; ++round) {
        if (neighbours == NormalNeighbours::All)
            averages_.average(normals_, means_, exec_);
        else
            averages_.average(same_side, normals_, means_, exec_);
        normalise(means_, exec_);
        normals_.swap(means_);
    }
}

/// Moves each vertex, again and again, by the mean of n ⟨n, c - x⟩ over its faces with averaged normals n and centroids
/// c, as far as its box allows (Sun et al., Fast and effective feature-preserving mesh denoising, 2007), with
/// Nesterov's momentum, with which it gets as far in seven rounds as in ten without.
void NormalsInBoxes::fit(Points& positions) const
{
    // ⟨n, c⟩ of each face.
    std::vector<double> heights(usize(mesh_.n_faces()));
    Points fitted = positions;
    for (int round = 0; round < fitting_rounds; ++round) {
        for_each(exec_, mesh_.n_faces(), [&](Index f) {
            Point total = Point::Zero();
            for (const Index v : mesh_.face(f))
                total += positions.row(v);
            const Point normal = normals_.row(f).head<3>().cast<double>();
            heights[f] = normal.dot(total) / static_cast<double>(mesh_.face(f).size());
        });
        const double momentum = round + 1 < fitting_rounds ? round / (round + 3.0) : 0.0;
        for_each(exec_, mesh_.n_vertices(), [&](Index v) {
            const auto corners = topology_.corners_at(v);
            if (corners.empty())
                return;
            const Point position = positions.row(v);
            Point total = Point::Zero();
            for (const Index corner : corners) {
                const Index f = topology_.face_of[corner];
                const Point normal = normals_.row(f).head<3>().cast<double>();
                total += normal * (heights[f] - normal.dot(position));
            }
            const Point after = boxes_.nearest(v, position + total / static_cast<double>(corners.size()));
            // The last round has no momentum: it ends in the box.
            positions.row(v) = after + momentum * (after - Point(fitted.row(v)));
            fitted.row(v) = after;
        });
    }
}

}  // namespace seamflow
