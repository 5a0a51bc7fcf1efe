#include "solvers/normals/smoothed_between_edges.h"

#include "solvers/normals/vertex_fit.h"

namespace seamflow {

Points smoothed_between_edges(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                              NormalDiffusion& diffusion, const Points& positions, double time_step, double angle,
                              const Executor& exec)
{
    // The number of times that normals diffuse and vertices move (measured: see engine/accuracy.md).
    constexpr int passes = 3;
    Points result = positions;
    for (int pass = 0; pass < passes; ++pass) {
        const Points normals = diffusion.smoothed(result, time_step / passes, angle, exec);
        fit_vertices(mesh, topology, lines, {normals, diffusion.noise()}, result, exec);
    }
    return result;
}

}  // namespace seamflow
