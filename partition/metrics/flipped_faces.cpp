#include "partition/metrics/flipped_faces.h"

#include "partition/vector_area.h"

namespace seamflow {

std::vector<Index> flipped_faces(const PolygonMesh& mesh, const Points& before, const Points& after, const Loop& loop)
{
    // Normalised, for areas of small faces may have a product that is 0.
    const auto normal = [&](Index f, const Points& positions) -> Point {
        return vector_area(mesh.face(f), positions).stableNormalized();
    };
    return select(loop, mesh.n_faces(), [&](Index f) { return normal(f, before).dot(normal(f, after)) < 0.0; });
}

}  // namespace seamflow
