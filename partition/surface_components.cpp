#include "partition/surface_components.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "partition/disjoint_sets.h"

namespace seamflow {

IndexLists SurfaceComponents::vertices() const
{
    return make_lists(count(), [&](auto&& add) {
        for (Index v = 0; v < static_cast<Index>(of_vertex.size()); ++v)
            if (of_vertex[v] >= 0)
                add(of_vertex[v], v);
    });
}

namespace {

/// Joins the vertices of each face.
void join_faces(const PolygonMesh& mesh, const Executor& exec, DisjointSets& sets)
{
    for_each(exec, mesh.n_faces(), [&](Index f) {
        const std::span<const Index> corners = mesh.face(f);
        for (std::size_t k = 1; k < corners.size(); ++k)
            sets.join(corners.front(), corners[k]);
    });
}

/// The components of the surface. A set of vertices is one of them if it has faces.
/// @param sets after join_faces.
SurfaceComponents list_components(const PolygonMesh& mesh, const Executor& exec, DisjointSets& sets)
{
    std::vector<Index> set_of;
    Index n_sets = 0;
    std::tie(set_of, n_sets) = sets.numbered(exec);
    if (n_sets == 1 && mesh.n_faces() > 0) {
        SurfaceComponents one;
        one.of_vertex = std::move(set_of);
        one.faces.values.resize(usize(mesh.n_faces()));
        std::iota(one.faces.values.begin(), one.faces.values.end(), 0);
        one.faces.close();
        return one;
    }
    // For each set, the number of its component; -1 for a vertex without faces.
    std::vector<Index> number(usize(n_sets), -1);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        number[set_of[mesh.face(f).front()]] = 0;
    Index n = 0;
    for (Index& one : number)
        one = one < 0 ? -1 : n++;
    SurfaceComponents found;
    found.faces = make_lists(n, [&](auto&& add) {
        for (Index f = 0; f < mesh.n_faces(); ++f)
            add(number[set_of[mesh.face(f).front()]], f);
    });
    for_each(exec, mesh.n_vertices(), [&](Index v) { set_of[v] = number[set_of[v]]; });
    found.of_vertex = std::move(set_of);
    return found;
}

}  // namespace

SurfaceComponents surface_components(const PolygonMesh& mesh, const Executor& exec)
{
    DisjointSets sets(mesh.n_vertices(), exec);
    join_faces(mesh, exec, sets);
    return list_components(mesh, exec, sets);
}

SurfaceComponents surface_components_if_several(const PolygonMesh& mesh, const Executor& exec)
{
    DisjointSets sets(mesh.n_vertices(), exec);
    join_faces(mesh, exec, sets);
    return sets.count(exec) > 1 ? list_components(mesh, exec, sets) : SurfaceComponents();
}

double largest_diagonal(const PolygonMesh& mesh, const Executor& exec)
{
    const SurfaceComponents components = surface_components(mesh, exec);
    std::vector<Eigen::AlignedBox3d> boxes(usize(components.count()));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (const Index c = components.of_vertex[v]; c >= 0)
            boxes[c].extend(mesh.vertices.row(v).transpose());
    double largest = 0.0;
    for (const Eigen::AlignedBox3d& box : boxes)
        largest = std::max(largest, box.diagonal().norm());
    return largest;
}

}  // namespace seamflow
