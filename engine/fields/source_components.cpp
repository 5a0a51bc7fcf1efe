#include "engine/fields/source_components.h"

#include <algorithm>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/connected_components.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "partition/vector_area.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/laplacian/flow_terms.h"

namespace seamflow {

std::vector<ComponentOfSources> components_of(const PolygonMesh& surface, std::span<const Index> from)
{
    const Topology topology = make_topology(surface, run_in_parallel);
    std::vector<Index> component_of(at(surface.n_vertices()), -1);
    std::vector<Index> local(at(surface.n_vertices()), -1);
    std::vector<ComponentOfSources> components;
    for (const Index source : from) {
        if (topology.corners_at(source).empty())
            continue;
        if (component_of[source] < 0) {
            const auto c = static_cast<Index>(components.size());
            std::vector<Index>& vertices = components.emplace_back().vertices;
            component_of[source] = c;
            append_reachable(source, vertices, [&](Index node, auto&& reach) {
                for (const Index corner : topology.corners_at(node))
                    for (const Index w : surface.face(topology.face_of[at(corner)]))
                        if (std::exchange(component_of[w], c) < 0)
                            reach(w);
            });
            std::ranges::sort(vertices);
            for (std::size_t i = 0; i < vertices.size(); ++i)
                local[vertices[i]] = static_cast<Index>(i);
        }
        components[at(component_of[source])].from.push_back(local[source]);
    }
    std::vector<Index> corners;
    for (Index f = 0; f < surface.n_faces(); ++f)
        if (const Index c = component_of[surface.face(f).front()]; c >= 0) {
            corners.clear();
            for (const Index v : surface.face(f))
                corners.push_back(local[v]);
            components[at(c)].mesh.add_face(corners);
        }
    for (ComponentOfSources& one : components) {
        one.mesh.vertices = rows_of(surface.vertices, one.vertices);
        const Point corner = one.mesh.vertices.row(0);
        one.mesh.vertices.rowwise() -= corner;
        one.unit = power_of_two_near(one.mesh.vertices.cwiseAbs().maxCoeff());
        one.mesh.vertices /= one.unit;
        sort_unique(one.from);
    }
    return components;
}

}  // namespace seamflow
