#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_piece.h"

namespace seamflow {

/// The true surface as far as it can be told from a noisy one.
struct DenoisedNormals {
    /// #F by 3: of length 1, on the side of the face's own normal in oriented meshes; 0 for faces without area.
    Points normals;
    /// #F: the standard deviation of the noise along the normals around each face, in lengths of the edges there.
    std::vector<float> noise;
};

/// Estimates the true normals of a noisy surface, and the noise.
///
/// Several filters give estimates of each normal (see NormalEstimates): strong and weak ones, filters that keep edges
/// and filters that keep round shapes. A network, which looks at how these estimates differ at the face and around it,
/// says how much each of them counts (MixingNetwork). The mix guides the filters of the next of a few stages. Such
/// cascades are known from regression of normals (Wang, Liu, Tong, Mesh denoising via cascaded normal regression,
/// 2016). In between, vertices are fitted to the normals, so that areas and distances have less noise, too.
///
/// A face's normal depends on the faces around it alone, and on nothing that depends on how the mesh is turned, scaled,
/// moved or numbered, except for rounding. Faces may have any number of sides. Bits do not depend on how loops are run.
///
/// A large mesh is denoised in pieces, one after the other, which overlap so far that hardly anything changes.
/// @param mesh its vertices are not used. @param topology twins are not used; vertices that it fixes stay.
/// @param positions #V by 3. @param most_faces see PieceSizes.
DenoisedNormals denoise_normals(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                const Executor& exec = run_serially, Index most_faces = PieceSizes().most_faces);

}  // namespace seamflow
