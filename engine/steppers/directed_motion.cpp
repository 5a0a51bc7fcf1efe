#include "engine/steppers/directed_motion.h"

namespace seamflow {

DirectedMotion::DirectedMotion(const PolygonMesh& mesh, const Topology& topology, const MotionDirection& direction)
    : direction_(direction.vector.stableNormalized())
{
    if (direction.kind == MotionDirection::Kind::Normal)
        normals_.emplace(mesh, topology);
}

void DirectedMotion::project(const Points& before, Points& after, const Executor& exec) const
{
    for_each(exec, static_cast<Index>(after.rows()), [&](Index v) {
        const Point from = before.row(v);
        const Point way = after.row(v) - from;
        after.row(v) = from;
        if (way.isZero(0.0))
            return;
        const Point d = normals_ ? (*normals_)(v, before) : direction_;
        const Point along = way.dot(d) * d;
        for (Index c = 0; c < 3; ++c)
            if (along[c] != 0.0)
                after(v, c) += along[c];
    });
}

}  // namespace seamflow
