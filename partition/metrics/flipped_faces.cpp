#include "partition/metrics/flipped_faces.h"

#include <algorithm>
#include <iterator>

#include "partition/vector_area.h"

namespace seamflow {

std::vector<Index> flipped_faces(const PolygonMesh& mesh, const Points& before, const Points& after,
                                 const Executor& exec)
{
    // The direction is normalised, because the product of the areas of small faces may be 0.
    const auto normal = [&](Index f, const Points& positions) -> Point {
        return vector_area(mesh.face(f), positions).stableNormalized();
    };
    return select(exec, mesh.n_faces(), [&](Index f) { return normal(f, before).dot(normal(f, after)) < 0.0; });
}

std::vector<Index> folded_faces(const PolygonMesh& mesh, const Points& before, const Points& after,
                                const std::vector<Index>& flipped)
{
    std::vector<char> has_flipped(usize(mesh.n_vertices()));
    for (const Index f : flipped)
        for (const Index v : mesh.face(f))
            has_flipped[v] = 1;
    // Per vertex, the sum of the vector areas of its faces.
    Points around_before = Points::Zero(mesh.n_vertices(), 3);
    Points around_after = Points::Zero(mesh.n_vertices(), 3);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        if (std::ranges::none_of(mesh.face(f), [&](Index v) { return has_flipped[v] != 0; }))
            continue;
        const Point was = vector_area(mesh.face(f), before);
        const Point is = vector_area(mesh.face(f), after);
        for (const Index v : mesh.face(f)) {
            around_before.row(v) += was;
            around_after.row(v) += is;
        }
    }
    // Negative if a face opposes the sum of the faces around its corners.
    const auto agreement = [&](Index f, const Points& positions, const Points& around) {
        const Point own = vector_area(mesh.face(f), positions);
        Point others = -static_cast<double>(mesh.face(f).size()) * own;
        for (const Index v : mesh.face(f))
            others += around.row(v);
        return own.stableNormalized().dot(others.stableNormalized());
    };
    std::vector<Index> folded;
    std::ranges::copy_if(flipped, std::back_inserter(folded), [&](Index f) {
        return agreement(f, before, around_before) > 0.0 && agreement(f, after, around_after) < 0.0;
    });
    return folded;
}

}  // namespace seamflow
