#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_piece.h"

namespace seamflow {

/// Estimates of the true surface of a noisy mesh.
struct DenoisedNormals {
    /// #F by 3: estimated normals, of length 1, on the side of the face's own normal in oriented meshes; 0 where
    /// neither the face nor the faces around it have an area.
    Points normals;
    /// #F: the standard deviation of the noise along the normals around each face, in lengths of the edges there.
    std::vector<float> noise;
};

/// Estimates the true normals of a noisy surface, and the noise.
///
/// Several filters give estimates of each normal (see NormalEstimates): strong and weak filters, filters that keep
/// edges and filters that keep round shapes. A network mixes them (MixingNetwork): from the differences of these
/// estimates at the face and around it, it computes a weight for each. The mixed normals guide the filters of the next
/// network. A few networks follow each other in such a cascade (Wang, Liu, Tong, Mesh denoising via cascaded normal
/// regression, 2016). Between two of them, vertices are fitted to the normals, so that areas and distances have less
/// noise, too.
///
/// The normal of a face depends only on the faces around it, and except for rounding not on the orientation, scale,
/// position and numbering of the mesh. Faces may have any number of sides. Bits do not depend on how loops are run.
///
/// A large mesh is denoised in pieces, one after the other. The pieces overlap so far that the result hardly changes.
/// @param mesh its vertices are not used. @param topology twins are not used; vertices that it fixes keep their
/// positions.
/// @param positions #V by 3. @param most_faces the approximate number of faces of a piece (see PieceSizes).
DenoisedNormals denoise_normals(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                const Executor& exec = run_serially, Index most_faces = PieceSizes().most_faces);

}  // namespace seamflow
