#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "samples/meshes/random_numbers.h"
#include "tests/support/loose_mesh.h"

namespace seamflow::test {

/// 10 to a random power.
inline double power_of_ten(double low, double high, RandomNumbers& random)
{
    return std::pow(10.0, low + (high - low) * random.unit());
}

/// How nice a random mesh is.
enum class Soundness {
    /// Manifold, oriented alike, without degenerate faces.
    Sound,
    /// Valid, but with anything that a scan or a modeller might leave: slivers, faces without area, edges without
    /// length, edges of three faces, pinches, faces turned round or repeated, vertices of high valence.
    Hard,
};

/// A valid mesh (see require_valid), and how it came about.
struct RandomMesh {
    PolygonMesh mesh;
    std::string description;
    Soundness soundness = Soundness::Sound;
};

/// A mesh of about 10 to 300 vertices and at least one face: a sphere, tori glued together, a Möbius band, a sheet, a
/// tube, or several of them, whose connectivity has been changed at random (edges flipped and split, faces split, cut,
/// merged into polygons, vertices split, the dual taken, holes cut), whose positions have noise, are stretched, turned,
/// scaled by 1e-6 to 1e6 and moved away from the origin, and whose vertices and faces are numbered at random.
RandomMesh random_mesh(RandomNumbers& random);

/// The numbers 0 to n - 1 in random order.
std::vector<Index> random_permutation(Index n, RandomNumbers& random);

/// The same mesh with other numbers: vertex v becomes new_vertex[v], face f comes from old_face[f].
PolygonMesh renumbered(const PolygonMesh& mesh, const std::vector<Index>& new_vertex,
                       const std::vector<Index>& old_face);

/// A mesh with its vertices and faces in random order, and the new number of each vertex.
struct ShuffledMesh {
    PolygonMesh mesh;
    std::vector<Index> new_vertex;
};

/// The same mesh, every face from any of its corners on.
ShuffledMesh shuffled(const PolygonMesh& mesh, std::uint32_t seed);

/// A label from 0 to about k - 1 for each face: regions that grow from k faces, or scattered ones.
std::vector<Index> random_cut(const PolygonMesh& mesh, Index k, RandomNumbers& random);

}  // namespace seamflow::test
