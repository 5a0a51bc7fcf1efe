#include "engine/distributed/cut/loose_parts.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/connected_components.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Some parts of a cut as one rank sees them.
struct WholeParts {
    MeshPart part;
    /// One entry per half-edge (see SlicedCut).
    std::vector<std::uint8_t> has_twin;
};

/// Gives each of these parts to one rank.
WholeParts deal_parts(Communicator& comm, const SlicedCut& cut, const std::vector<Index>& parts)
{
    const RankSlice& slice = cut.slice;
    const auto place_of = [&](Index label) { return position_in(parts, label); };
    const auto wanted =
        select(run_in_parallel, slice.n_faces(), [&](Index f) { return place_of(slice.labels[f]) >= 0; });
    std::vector<Packer> to_each(comm.size());
    for (const Index f : wanted) {
        const auto owner = static_cast<std::size_t>(place_of(slice.labels[f])) * to_each.size() / parts.size();
        const std::size_t begin = at(slice.face_offsets[f]);
        const std::size_t size = at(slice.face_offsets[f + 1]) - begin;
        to_each[owner].put(cut.bounds.faces[comm.rank()] + f);
        to_each[owner].put(slice.labels[f]);
        to_each[owner].put_all(std::span<const std::int64_t>(slice.corners).subspan(begin, size));
        to_each[owner].put_all(std::span<const std::uint8_t>(cut.has_twin).subspan(begin, size));
    }
    std::vector<Bytes> sent;
    for (Packer& packer : to_each)
        sent.push_back(packer.take());
    WholeParts whole;
    std::vector<std::int64_t> corners;
    for (const Bytes& bytes : comm.exchange(std::move(sent)))
        for (Unpacker unpacker(bytes); !unpacker.is_at_end();) {
            whole.part.face_numbers.push_back(unpacker.get<std::int64_t>());
            whole.part.labels.push_back(unpacker.get<Index>());
            const auto of_face = unpacker.get_all<std::int64_t>();
            corners.insert(corners.end(), of_face.begin(), of_face.end());
            whole.part.mesh.face_offsets.push_back(static_cast<Index>(corners.size()));
            const auto twins = unpacker.get_all<std::uint8_t>();
            whole.has_twin.insert(whole.has_twin.end(), twins.begin(), twins.end());
        }
    whole.part.vertex_numbers = corners;
    sort_unique(whole.part.vertex_numbers);
    for (const std::int64_t corner : corners)
        whole.part.mesh.face_vertices.push_back(place_in(whole.part.vertex_numbers, corner));
    // Their positions are not needed.
    whole.part.mesh.vertices = Points::Zero(std::ssize(whole.part.vertex_numbers), 3);
    return whole;
}

/// The components of parts except the largest of each (of equals, the one with the lowest face).
LooseFaces find_loose(const WholeParts& whole)
{
    LooseFaces loose;
    const MeshPart& part = whole.part;
    const PolygonMesh& mesh = part.mesh;
    const Topology topology = make_topology(mesh, run_in_parallel);
    const Components components = connected_components(mesh.n_faces(), [&](Index f, auto&& visit) {
        for_each_neighbour(mesh, topology, f, [&](Index h, Index g) {
            if (whole.has_twin[h] != 0 && part.labels[f] == part.labels[g])
                visit(g);
        });
    });
    const auto label_of = [&](Index component) { return part.labels[components.nodes[component].front()]; };
    std::map<Index, Index> largest;
    for (Index component = 0; component < components.count(); ++component) {
        const auto [found, is_first] = largest.try_emplace(label_of(component), component);
        if (components.nodes[component].size() > components.nodes[found->second].size())
            found->second = component;
    }
    for (Index component = 0; component < components.count(); ++component) {
        if (largest.at(label_of(component)) == component)
            continue;
        for (const Index f : components.nodes[component]) {
            loose.faces.push_back(part.face_numbers[f]);
            for (const Index v : mesh.face(f))
                loose.corners.push_back(part.vertex_numbers[v]);
        }
        loose.component_sizes.push_back(static_cast<Index>(components.nodes[component].size()));
    }
    return loose;
}

}  // namespace

LooseFaces gather_loose(Communicator& comm, const SlicedCut& cut, const std::vector<Index>& parts)
{
    const LooseFaces own = find_loose(deal_parts(comm, cut, parts));
    return {.faces = comm.gather_at_first(own.faces),
            .component_sizes = comm.gather_at_first(own.component_sizes),
            .corners = comm.gather_at_first(own.corners)};
}

IndexLists components_in(const Band& band, const LooseFaces& loose)
{
    std::vector<std::span<const std::int64_t>> sorted;
    std::size_t begin = 0;
    for (const Index size : loose.component_sizes) {
        sorted.push_back(std::span(loose.faces).subspan(begin, at(size)));
        begin += at(size);
    }
    std::ranges::sort(sorted, {}, [](std::span<const std::int64_t> component) { return component.front(); });
    IndexLists components;
    for (const auto& component : sorted) {
        for (const std::int64_t face : component)
            components.values.push_back(place_in(band.part.face_numbers, face));
        components.close();
    }
    return components;
}

std::vector<Index> join_to_neighbours(const Band& band, const IndexLists& components, Index& n_parts)
{
    const PolygonMesh& mesh = band.part.mesh;
    const Topology topology = make_topology(mesh, run_in_parallel);
    constexpr Index settled = -1;
    constexpr Index loose = -1;
    std::vector<Index> component_of(mesh.n_faces(), settled);
    for (Index component = 0; component < components.size(); ++component)
        for (const Index f : components[component])
            component_of[f] = component;
    std::vector<Index> joined(components.size(), loose);
    const auto join = [&](Index component) {
        std::map<Index, Index> shared;
        for (const Index f : components[component])
            for_each_neighbour(mesh, topology, f, [&](Index, Index g) {
                const Index label = component_of[g] == settled ? band.part.labels[g] : joined[component_of[g]];
                if (label != loose)
                    ++shared[label];
            });
        const auto best = std::ranges::max_element(shared, {}, [](const auto& entry) { return entry.second; });
        if (best == shared.end())
            return false;
        joined[component] = best->first;
        return true;
    };
    for (bool any = true; any;) {
        any = false;
        for (Index component = 0; component < components.size(); ++component)
            any = (joined[component] == loose && join(component)) || any;
    }
    for (Index& label : joined)
        if (label == loose)
            label = n_parts++;
    return joined;
}

}  // namespace seamflow
