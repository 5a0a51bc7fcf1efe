#include "partition/decomposition/local_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace seamflow {

namespace {

/// Positions in an ascending list, found in constant time.
class PositionTable {
  public:
    /// The list must outlive the table. @param most how many there may be.
    explicit PositionTable(std::size_t most)
        : mask_(std::bit_ceil(2 * most + 1) - 1)
        , slots_(mask_ + 1, {-1, -1})
    {
    }

    /// @returns whether `value`, at least 0, was not in the table.
    bool insert(Index value)
    {
        Slot& slot = slots_[slot_of(value)];
        const bool is_new = slot.value < 0;
        slot.value = value;
        return is_new;
    }

    void set_positions(std::span<const Index> values)
    {
        for (std::size_t i = 0; i < values.size(); ++i)
            slots_[slot_of(values[i])] = {values[i], static_cast<Index>(i)};
    }

    /// -1 for what is not in the table.
    [[nodiscard]] Index operator[](Index value) const { return slots_[slot_of(value)].position; }

  private:
    struct Slot {
        Index value;
        Index position;
    };

    /// Where `value` is, or the free slot for it.
    [[nodiscard]] std::size_t slot_of(Index value) const
    {
        std::size_t slot = static_cast<std::size_t>(static_cast<std::uint32_t>(value) * 2654435769U) & mask_;
        while (slots_[slot].value != value && slots_[slot].value >= 0)
            slot = (slot + 1) & mask_;
        return slot;
    }

    std::size_t mask_;
    std::vector<Slot> slots_;
};

std::size_t count_corners(const PolygonMesh& mesh, std::span<const Index> faces)
{
    std::size_t n = 0;
    for (const Index f : faces)
        n += mesh.face(f).size();
    return n;
}

void copy_vertices(const PolygonMesh& mesh, std::size_t n_corners, SubMesh& sub_mesh)
{
    PositionTable vertices(n_corners);
    for (const Index f : sub_mesh.faces)
        for (const Index v : mesh.face(f))
            if (vertices.insert(v))
                sub_mesh.local_to_global.push_back(v);
    std::sort(sub_mesh.local_to_global.begin(), sub_mesh.local_to_global.end());
    sub_mesh.n_vertices = static_cast<Index>(sub_mesh.local_to_global.size());
    vertices.set_positions(sub_mesh.local_to_global);

    sub_mesh.face_vertices.offsets.reserve(sub_mesh.faces.size() + 1);
    sub_mesh.face_vertices.values.reserve(n_corners);
    for (const Index f : sub_mesh.faces) {
        for (const Index v : mesh.face(f))
            sub_mesh.face_vertices.values.push_back(vertices[v]);
        sub_mesh.face_vertices.close();
    }
}

void copy_twins(const PolygonMesh& mesh, const Topology& topology, SubMesh& sub_mesh)
{
    PositionTable faces(sub_mesh.faces.size());
    faces.set_positions(sub_mesh.faces);
    sub_mesh.twin.reserve(sub_mesh.face_vertices.values.size());
    for (const Index f : sub_mesh.faces)
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            const Index face = twin < 0 ? -1 : faces[topology.face_of[at(twin)]];
            sub_mesh.twin.push_back(face < 0 ? -1
                                             : sub_mesh.face_vertices.offsets[at(face)] + twin -
                                                   mesh.face_offsets[at(topology.face_of[at(twin)])]);
        }
}

void mark_fixed(const Topology& topology, SubMesh& sub_mesh)
{
    sub_mesh.fixed.reserve(sub_mesh.local_to_global.size());
    for (const Index v : sub_mesh.local_to_global)
        sub_mesh.fixed.push_back(topology.kind[at(v)] == VertexKind::Interior ? 0 : 1);
}

}  // namespace

void sort_unique(std::vector<Index>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

Index position_in(std::span<const Index> ascending, Index value)
{
    const auto found = std::lower_bound(ascending.begin(), ascending.end(), value);
    return found != ascending.end() && *found == value ? static_cast<Index>(found - ascending.begin()) : -1;
}

bool is_on_interface(const Topology& topology, std::span<const Index> labels, Index v)
{
    if (topology.kind[at(v)] != VertexKind::Interior)
        return false;
    const auto corners = topology.corners_at(v);
    const auto label_of = [&](Index corner) { return labels[at(topology.face_of[at(corner)])]; };
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index corner) { return label_of(corner) != label_of(corners.front()); });
}

std::vector<Index> labels_at(const Topology& topology, std::span<const Index> labels, Index v)
{
    std::vector<Index> found;
    for (const Index corner : topology.corners_at(v))
        found.push_back(labels[at(topology.face_of[at(corner)])]);
    sort_unique(found);
    return found;
}

std::vector<Index> edge_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    std::vector<Index> neighbours;
    for (const Index corner : topology.corners_at(v)) {
        neighbours.push_back(mesh.face_vertices[at(topology.next(mesh, corner))]);
        neighbours.push_back(mesh.face_vertices[at(topology.previous(mesh, corner))]);
    }
    sort_unique(neighbours);
    return neighbours;
}

SubMesh copy_faces(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> faces)
{
    SubMesh sub_mesh;
    sub_mesh.faces = std::move(faces);
    copy_vertices(mesh, count_corners(mesh, sub_mesh.faces), sub_mesh);
    copy_twins(mesh, topology, sub_mesh);
    mark_fixed(topology, sub_mesh);
    return sub_mesh;
}

void append_halo(std::vector<Index> vertices, SubMesh& sub_mesh)
{
    sort_unique(vertices);
    std::erase_if(vertices, [&](Index v) { return local_index(sub_mesh, v) >= 0; });
    sub_mesh.n_halo = static_cast<Index>(vertices.size());
    sub_mesh.local_to_global.insert(sub_mesh.local_to_global.end(), vertices.begin(), vertices.end());
}

Index local_or_halo_index(const SubMesh& sub_mesh, Index v)
{
    const Index own = local_index(sub_mesh, v);
    if (own >= 0)
        return own;
    const auto halo = std::span<const Index>(sub_mesh.local_to_global).subspan(at(sub_mesh.n_vertices));
    return sub_mesh.n_vertices + position_in(halo, v);
}

void append_to_seam(const PolygonMesh& mesh, const Topology& topology, Index v, SubMesh& sub_mesh)
{
    sub_mesh.seam.vertices.push_back(local_index(sub_mesh, v));
    for (const Index neighbour : edge_neighbours(mesh, topology, v))
        sub_mesh.seam.neighbours.values.push_back(local_or_halo_index(sub_mesh, neighbour));
    sub_mesh.seam.neighbours.close();
}

void mark_owned(const Topology& topology, std::span<const Index> labels, Index own, SubMesh& sub_mesh)
{
    sub_mesh.owned.resize(at(sub_mesh.n_vertices));
    for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
        const auto corners = topology.corners_at(sub_mesh.local_to_global[at(i)]);
        Index lowest = labels[at(topology.face_of[at(corners.front())])];
        for (const Index corner : corners)
            lowest = std::min(lowest, labels[at(topology.face_of[at(corner)])]);
        sub_mesh.owned[at(i)] = sub_mesh.fixed[at(i)] == 0 && lowest == own ? 1 : 0;
    }
}

}  // namespace seamflow
