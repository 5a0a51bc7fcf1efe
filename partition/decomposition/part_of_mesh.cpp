#include "partition/decomposition/part_of_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "partition/decomposition/local_mesh.h"
#include "partition/decomposition/make_sub_mesh.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// The sub-mesh of a fragment (see decompose_part): vertices and the numbers of faces, but no equations.
SubMesh make_fragment(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> faces)
{
    SubMesh fragment = copy_faces(mesh, topology, std::move(faces)).sub_mesh;
    fragment.owned.assign(fragment.n_vertices, 0);
    fragment.face_vertices = {};
    fragment.twin = {};
    return fragment;
}

/// Makes a whole sub-mesh own a vertex that a fragment would own, if it is the lowest whole sub-mesh there.
void speak_for_fragments(const Topology& topology, std::span<const Index> labels,
                         std::span<const std::uint8_t> is_whole, Index s, SubMesh& sub_mesh)
{
    std::vector<Index> around;
    for (const Index v : sub_mesh.interface.vertices) {
        labels_around(topology, labels, sub_mesh.local_to_global[v], around);
        if (*std::ranges::find_if(around, [&](Index t) { return is_whole[t] != 0; }) == s)
            sub_mesh.owned[v] = 1;
    }
}

}  // namespace

Decomposition decompose_part(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                             std::span<const std::uint8_t> is_whole, const Executor& exec)
{
    const auto n = static_cast<Index>(is_whole.size());
    auto faces = faces_by_label(labels, n, exec);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(exec, n, [&](Index s) {
        sub_meshes[s] = is_whole[s] != 0 ? make_sub_mesh(mesh, topology, labels, std::move(faces[s]))
                                         : make_fragment(mesh, topology, std::move(faces[s]));
    });
    Decomposition decomposition = connect(std::move(sub_meshes), topology, labels, exec);
    for_each(exec, n, [&](Index s) {
        if (is_whole[s] != 0)
            speak_for_fragments(topology, labels, is_whole, s, decomposition.sub_meshes[s]);
    });
    return decomposition;
}

}  // namespace seamflow
