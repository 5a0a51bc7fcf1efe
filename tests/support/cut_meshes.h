#pragma once

#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/decomposition/decomposition.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow::test {

/// A mesh with a valid cut, and a name for the messages of tests.
struct CutMesh {
    std::string name;
    PolygonMesh mesh;
    Topology topology;
    std::vector<Index> labels;
    Index n_parts = 0;
};

/// A mesh cut by hand: the label of each face is a function of its centroid. Repaired where it is no valid cut.
CutMesh cut_by_place(const std::string& name, PolygonMesh mesh, const std::function<Index(const Point&)>& label_at);

/// Small meshes of each sort (triangles, quads, hexagons, mixed polygons, one of 80 corners; flat, curved, closed, not
/// orientable, of several components), each cut by hand in 2, 3 and 4 with cross points and by METIS in 2 and 8.
const std::vector<CutMesh>& cut_meshes();

Decomposition decompose(const CutMesh& cut);

/// Calls `check` with every cut mesh and each of its sub-meshes.
template <class Check>
void for_each_sub_mesh(Check&& check)
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = decompose(cut);
        for (const SubMesh& sub_mesh : decomposition.sub_meshes)
            check(cut, sub_mesh);
    }
}

/// The rows of `positions` in a sub-mesh's own order, the halo included.
Points localised(const SubMesh& sub_mesh, const Points& positions);

}  // namespace seamflow::test
