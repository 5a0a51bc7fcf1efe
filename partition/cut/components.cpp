#include "partition/cut/components.h"

#include "partition/cut/at.h"

namespace seamflow
{

namespace
{

/// Gives `component` to all faces that hang together with the one on the stack.
void flood(const PolygonMesh& mesh, const Topology& topology, Index id, std::vector<Index>& stack,
           std::vector<Index>& component)
{
    while (!stack.empty()) {
        const Index f = stack.back();
        stack.pop_back();
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            if (twin < 0 || component[at(topology.face_of[at(twin)])] >= 0)
                continue;
            component[at(topology.face_of[at(twin)])] = id;
            stack.push_back(topology.face_of[at(twin)]);
        }
    }
}

}  // namespace

FaceComponents face_components(const PolygonMesh& mesh, const Topology& topology)
{
    FaceComponents result;
    result.component.assign(at(mesh.n_faces()), -1);
    std::vector<Index> stack;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        if (result.component[at(f)] >= 0)
            continue;
        result.component[at(f)] = result.count;
        stack.push_back(f);
        flood(mesh, topology, result.count++, stack, result.component);
    }
    return result;
}

}  // namespace seamflow
