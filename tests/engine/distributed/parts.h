#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/mesh_part.h"
#include "partition/index_lists.h"

namespace seamflow::test {

/// The part of a mesh that a rank of n has when sub-meshes are dealt in turns: some of them with all their faces.
/// @param labels #F.
/// @param fixed vertices that stay.
inline MeshPart part_of(const PolygonMesh& mesh, const std::vector<Index>& labels, int rank, int n,
                        const std::vector<Index>& fixed = {})
{
    const auto is_own = [&](Index label) { return label % n == rank; };
    std::vector<Index> vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (is_own(labels[f]))
            vertices.insert(vertices.end(), mesh.face(f).begin(), mesh.face(f).end());
    sort_unique(vertices);
    MeshPart part;
    part.mesh.vertices = mesh.vertices(vertices, Eigen::all);
    part.vertex_numbers.assign(vertices.begin(), vertices.end());
    for (const Index v : vertices)
        part.fixed.push_back(std::ranges::find(fixed, v) != fixed.end() ? 1 : 0);
    std::vector<Index> corners;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        if (!is_own(labels[f]))
            continue;
        corners.clear();
        for (const Index v : mesh.face(f))
            corners.push_back(static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin()));
        part.mesh.add_face(corners);
        part.face_numbers.push_back(f);
        part.labels.push_back(labels[f]);
    }
    return part;
}

/// What rank of n reads, if each reads as many faces and vertices.
inline RankSlice slice_of(const PolygonMesh& mesh, const std::vector<Index>& labels, int rank, int n)
{
    RankSlice slice;
    const auto bound = [n](Index all, int r) { return static_cast<Index>(std::int64_t{all} * r / n); };
    const Index first = bound(mesh.n_vertices(), rank);
    slice.vertices = mesh.vertices.middleRows(first, bound(mesh.n_vertices(), rank + 1) - first);
    for (Index f = bound(mesh.n_faces(), rank); f < bound(mesh.n_faces(), rank + 1); ++f) {
        slice.corners.insert(slice.corners.end(), mesh.face(f).begin(), mesh.face(f).end());
        slice.face_offsets.push_back(static_cast<Index>(slice.corners.size()));
        slice.labels.push_back(labels[f]);
    }
    return slice;
}

}  // namespace seamflow::test
