#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Checks that the Laplacian's coefficients are finite at all vertices that may move: Fujiwara divides by the lengths
/// of their edges, Alexa-Wardetzky and VirtualRefinement by the areas of their faces, Ptáčková-Velho also by the areas
/// of the faces next to these.
/// @throws InputError naming the first edge without length or face without area, and a remedy.
void require_sound_geometry(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                            const Executor& exec = run_serially);

/// Checks that all edges have a length and all faces an area, whatever the Laplacian divides by.
/// @throws InputError as require_sound_geometry.
void require_sizes(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The vertices that may move and at which the Laplacian's coefficients are not finite (see require_sound_geometry),
/// ascending.
std::vector<Index> vertices_without_row(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                        const Executor& exec = run_serially);

}  // namespace seamflow
