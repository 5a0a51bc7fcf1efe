#pragma once

#include <string>

#include "tests/support/loose_mesh.h"

namespace seamflow::test {

/// Does something to a mesh that leaves it valid, but hard to flow: slivers, faces without area, edges without length,
/// edges of three faces, pinches, faces turned round or repeated, vertices of high valence.
/// @returns what it did, in a few words.
std::string damage(LooseMesh& mesh, RandomNumbers& random);

}  // namespace seamflow::test
